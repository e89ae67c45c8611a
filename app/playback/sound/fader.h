#pragma once

#include <algorithm>

#include "app/playback/clock/show_clock.h"

namespace ergodome {

//! Fades between 0 and 1. A fade can reverse at any point.
class Fader {
 public:
  //! `whole` is the duration of a full fade; 0 switches at once.
  explicit Fader(std::chrono::nanoseconds whole, double value = 1.0) : whole_(whole), from_(value), target_(value) {}

  //! Starts a fade to 0 or 1.
  void go(double target, MonotonicTime now) {
    from_ = position(now);
    since_ = now;
    target_ = target > 0.5 ? 1.0 : 0.0;
  }

  void set_whole(std::chrono::nanoseconds whole, MonotonicTime now) {
    go(target_, now);
    whole_ = whole;
  }

  [[nodiscard]] double target() const { return target_; }
  [[nodiscard]] std::chrono::nanoseconds whole() const { return whole_; }

  //! Returns the value, which is slow at both ends: 3 p² - 2 p³ of the progress p.
  [[nodiscard]] double value(MonotonicTime now) const {
    const double p = position(now);
    return p * p * (3.0 - 2.0 * p);
  }

 private:
  //! Returns the progress, which is linear in time.
  [[nodiscard]] double position(MonotonicTime now) const {
    if (whole_ <= std::chrono::nanoseconds{}) {
      return target_;
    }
    const double moved = seconds_of(now - since_) / seconds_of(whole_);
    return target_ > from_ ? std::min(from_ + moved, target_) : std::max(from_ - moved, target_);
  }

  std::chrono::nanoseconds whole_;
  double from_;
  double target_;
  MonotonicTime since_{};
};

}  // namespace ergodome
