#pragma once

#include <nlohmann/json.hpp>

#include "render/stereo/narrowed_eyes.h"

namespace ergodome {

//! Returns where and when the baseline is first reduced, and where it is smallest.
inline nlohmann::json facts_of(const NarrowedPath& path) {
  const auto facts = [](double time_s, const NarrowedEyes& eyes) {
    return nlohmann::json{{"t_s", time_s}, {"r", eyes.r}, {"asked", eyes.asked}, {"baseline", eyes.baseline}};
  };
  return {{"first", facts(path.first_s, path.first)}, {"least", facts(path.least_s, path.least)}};
}

}  // namespace ergodome
