#pragma once

#include <chrono>
#include <optional>
#include <string>

#include "app/commands/calibrate/live_calibration.h"

namespace ergodome {

//! Returns the action of a key, given by its GLFW number.
CalibrationAction calibration_action_of(int key);

//! Returns a line for each key and what it does, beginning with `indent`.
std::string calibration_key_lines(const std::string& indent);

//! Tracks the key that is held down and when its action repeats.
//!
//! An action may take longer than the key is held, so report all pending events before calling
//! due().
class KeyRepeat {
 public:
  using Time = std::chrono::steady_clock::time_point;

  //! Records that a key was pressed.
  void press(int key, Time now) {
    held_ = key;
    due_ = now + std::chrono::milliseconds(400);
  }

  void release(int key) {
    if (held_ == key) {
      held_.reset();
    }
  }

  //! Returns the key whose action has to be repeated.
  [[nodiscard]] std::optional<int> due(Time now) const { return held_ && now >= due_ ? held_ : std::nullopt; }

  //! Records that the action was repeated.
  void repeated(Time now) { due_ = now + std::chrono::milliseconds(80); }

 private:
  std::optional<int> held_;
  Time due_;
};

}  // namespace ergodome
