#pragma once

#include <chrono>
#include <optional>

namespace ergodome {

//! Which key is held, and when what it does is to be done again.
//!
//! Times are those after the work that a key has asked for: while it is done nobody knows whether the key has been let go.
class KeyRepeat {
 public:
  using Time = std::chrono::steady_clock::time_point;

  //! A key went down, and what it does was done by `now`.
  void press(int key, Time now) {
    held_ = key;
    due_ = now + std::chrono::milliseconds(400);
  }

  void release(int key) {
    if (held_ == key) {
      held_.reset();
    }
  }

  //! The key that is to do again what it does, once all events up to `now` are known.
  [[nodiscard]] std::optional<int> due(Time now) const { return held_ && now >= due_ ? held_ : std::nullopt; }

  //! It has done so by `now`.
  void repeated(Time now) { due_ = now + std::chrono::milliseconds(80); }

 private:
  std::optional<int> held_;
  Time due_;
};

}  // namespace ergodome
