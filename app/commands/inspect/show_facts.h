#pragma once

#include <nlohmann/json.hpp>
#include <nlohmann/json_fwd.hpp>

#include "content/show/show.h"
#include "render/stereo/narrowed_eyes.h"

namespace ergodome {

//! Returns the unused keys of a show as a list (content/show/idle_lines.h).
nlohmann::json facts_of_idle_lines(const Show& show);

//! Prints a list of unused keys; nothing if it is empty.
void print_idle_lines(const nlohmann::json& lines);

//! Returns where and when the baseline is first reduced, and where it is smallest.
inline nlohmann::json facts_of(const NarrowedPath& path) {
  const auto facts = [](double time_s, const NarrowedEyes& eyes) {
    return nlohmann::json{{"t_s", time_s}, {"r", eyes.r}, {"asked", eyes.asked}, {"baseline", eyes.baseline}};
  };
  return {{"first", facts(path.first_s, path.first)}, {"least", facts(path.least_s, path.least)}};
}

}  // namespace ergodome
