#pragma once

#include <string>

#include "app/live_calibration.h"

namespace ergodome {

//! What a key does, by GLFW's number.
CalibrationAction calibration_action_of(int key);

//! The keys, a line each, for --help.
std::string calibration_key_help();

}  // namespace ergodome
