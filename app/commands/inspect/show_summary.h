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

//! Returns the show time and the radius at which the baseline is first reduced, and those at which
//! it is smallest, each with the requested and the reduced baseline [M].
inline nlohmann::json summary_of(const BaselineReductions& path) {
  const auto summary = [](double time_s, const ReducedBaseline& eyes) {
    return nlohmann::json{{"t_s", time_s}, {"r", eyes.r}, {"asked", eyes.asked}, {"baseline", eyes.baseline}};
  };
  return {{"first", summary(path.first_s, path.first)}, {"least", summary(path.smallest_s, path.smallest)}};
}

}  // namespace ergodome
