#pragma once

#include <chrono>
#include <optional>

namespace ergodome {

//! Which key is held, and when what it does is to be done again.
//!
//! Work that a key asks for may take longer than it is held: due() is asked once all that happened until now has been told.
class KeyRepeat {
 public:
  using Time = std::chrono::steady_clock::time_point;

  //! A key went down.
  void press(int key, Time now) {
    held_ = key;
    due_ = now + std::chrono::milliseconds(400);
  }

  void release(int key) {
    if (held_ == key) {
      held_.reset();
    }
  }

  //! The key that is to do again what it does.
  [[nodiscard]] std::optional<int> due(Time now) const { return held_ && now >= due_ ? held_ : std::nullopt; }

  //! It does so.
  void repeated(Time now) { due_ = now + std::chrono::milliseconds(80); }

 private:
  std::optional<int> held_;
  Time due_;
};

}  // namespace ergodome
