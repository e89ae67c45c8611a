#pragma once

#include "app/playback/clock/show_clock.h"

namespace ergodome::test {

//! A clock that the test sets. Must outlive everything that uses it.
struct FakeTime {
  MonotonicTime now = std::chrono::hours(5);

  [[nodiscard]] TimeSource source() {
    return [this] { return now; };
  }
  void pass(double seconds) { now += show_time(seconds); }
};

}  // namespace ergodome::test
