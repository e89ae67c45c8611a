#pragma once

#include <string>

#include "app/commands/calibrate/live_calibration.h"

namespace ergodome {

//! Returns the action of a key, given by its GLFW number.
CalibrationAction calibration_action_of(int key);

//! Returns a line for each key and what it does, beginning with `indent`.
std::string calibration_key_lines(const std::string& indent);

}  // namespace ergodome
