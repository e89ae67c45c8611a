#pragma once

#include <algorithm>
#include <chrono>

namespace ergodome {

//! Limits a rate to `per_s` per second on average, with bursts of `burst`. Not thread-safe.
class RateLimit {
 public:
  RateLimit(double per_s, double burst) : per_s_(per_s), burst_(burst), left_(burst) {}

  bool allows(std::chrono::steady_clock::time_point now) {
    if (now > last_) {
      left_ = std::min(burst_, left_ + per_s_ * std::chrono::duration<double>(now - last_).count());
      last_ = now;
    }
    if (left_ < 1.0) {
      return false;
    }
    left_ -= 1.0;
    return true;
  }

 private:
  double per_s_;
  double burst_;
  double left_;
  std::chrono::steady_clock::time_point last_;
};

}  // namespace ergodome
