#pragma once

#include <algorithm>
#include <deque>
#include <utility>

namespace ergodome {

//! The maximum of the frame times of the last ten seconds.
class FrameTimes {
 public:
  //! Adds a frame time. `now_s` is from a monotonic clock.
  void note(double now_s, double frame_ms) {
    constexpr double window_s = 10.0;
    while (!times_.empty() && now_s - times_.front().first > window_s) {
      times_.pop_front();
    }
    // An older and shorter time can never become the maximum.
    while (!times_.empty() && times_.back().second <= frame_ms) {
      times_.pop_back();
    }
    times_.emplace_back(now_s, frame_ms);
  }

  [[nodiscard]] double worst_ms() const { return times_.empty() ? 0.0 : times_.front().second; }

 private:
  //! (time, frame time), with decreasing frame times.
  std::deque<std::pair<double, double>> times_;
};

}  // namespace ergodome
