#pragma once

#include <algorithm>
#include <limits>

namespace ergodome {

//! Schedules frames at a fixed rate, by a monotonic clock [s]. Up to half a frame of lateness is
//! made up for by later frames, so that the mean rate holds; more is lost.
class FramePace {
 public:
  explicit FramePace(double frame_s) : frame_s_(frame_s) {}

  [[nodiscard]] bool is_due(double now_s) const { return now_s >= due_s_; }

  //! Records the start of a frame.
  void begin(double now_s) { due_s_ = std::max(due_s_, now_s - 0.5 * frame_s_) + frame_s_; }

 private:
  double frame_s_;
  double due_s_ = -std::numeric_limits<double>::infinity();  //!< when the next frame is due
};

}  // namespace ergodome
