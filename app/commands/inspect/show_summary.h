#pragma once

#include <nlohmann/json.hpp>
#include <nlohmann/json_fwd.hpp>

#include "content/show/show.h"
#include "render/stereo/reduced_baseline.h"

namespace ergodome {

//! Returns the unused keys of a show (content/show/unused_keys.h) as a list of key, line in the
//! show file (null for --set) and reason.
nlohmann::json summary_of_unused_keys(const Show& show);

//! Prints a list of unused keys; nothing if it is empty.
void print_unused_keys(const nlohmann::json& lines);

//! Returns where and when the baseline is first reduced, and where and when it is smallest, each
//! with the baseline [M] that was asked for and the reduced one.
inline nlohmann::json summary_of(const BaselineReductions& path) {
  const auto summary = [](double time_s, const ReducedBaseline& eyes) {
    return nlohmann::json{{"t_s", time_s}, {"r", eyes.r}, {"asked", eyes.asked}, {"baseline", eyes.baseline}};
  };
  return {{"first", summary(path.first_s, path.first)}, {"least", summary(path.smallest_s, path.smallest)}};
}

}  // namespace ergodome
