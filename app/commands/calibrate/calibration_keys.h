#pragma once

#include <chrono>
#include <optional>
#include <string>

#include "app/commands/calibrate/live_calibration.h"

namespace ergodome {

//! Returns the action of a key, given by its GLFW number; `none` if it has no action.
CalibrationAction calibration_action_of(int key);

//! Returns help lines, each of which starts with `indent` and says what one or more keys do.
std::string calibration_key_lines(const std::string& indent);

//! Tracks the key that is held down and when its action repeats.
//!
//! An action may take longer than the key is held, so report all pending events before calling
//! due().
class KeyRepeat {
 public:
  using Time = std::chrono::steady_clock::time_point;

  //! Records that a key was pressed; its action is first repeated after 400 ms.
  void press(int key, Time now) {
    held_ = key;
    due_ = now + std::chrono::milliseconds(400);
  }

  void release(int key) {
    if (held_ == key) {
      held_.reset();
    }
  }

  //! Returns the held key if its action has to be repeated now.
  [[nodiscard]] std::optional<int> due(Time now) const { return held_ && now >= due_ ? held_ : std::nullopt; }

  //! Records that the action was repeated; the next time is 80 ms later.
  void repeated(Time now) { due_ = now + std::chrono::milliseconds(80); }

 private:
  std::optional<int> held_;
  Time due_;
};

}  // namespace ergodome
