#pragma once

#include <string>

#include "app/live_calibration.h"

namespace ergodome {

//! What a key does, by GLFW's number.
CalibrationAction calibration_action_of(int key);

//! Returns the keys and what they do, a line each.
std::string calibration_key_lines(const std::string& indent);

}  // namespace ergodome
