#pragma once

#include <vector>

#include "content/show/animatable_number.h"

namespace ergodome {

//! Returns the animatable numbers of all shells that a show can have: "shells[0].radius" and so on,
//! counted from 0 in the order of the file.
const std::vector<AnimatableNumber>& shell_numbers();

}  // namespace ergodome
