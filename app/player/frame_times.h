#pragma once

#include <algorithm>
#include <deque>
#include <utility>

namespace ergodome {

//! The longest of the last ten seconds' frame times.
class FrameTimes {
 public:
  //! By a clock that never goes back.
  void note(double now_s, double frame_ms) {
    constexpr double window_s = 10.0;
    while (!times_.empty() && now_s - times_.front().first > window_s) {
      times_.pop_front();
    }
    // What is shorter and older can never be the longest again.
    while (!times_.empty() && times_.back().second <= frame_ms) {
      times_.pop_back();
    }
    times_.emplace_back(now_s, frame_ms);
  }

  [[nodiscard]] double worst_ms() const { return times_.empty() ? 0.0 : times_.front().second; }

 private:
  std::deque<std::pair<double, double>> times_;  //!< falling
};

}  // namespace ergodome
