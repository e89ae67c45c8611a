#pragma once

#include <algorithm>
#include <limits>

namespace ergodome {

//! When frames of a rate are due, by a clock of seconds that only goes forward. Of a late frame, as much as half
//! a frame's time is made up for by those after it, so that the mean rate holds; time that is lost beyond is lost.
class FramePace {
 public:
  explicit FramePace(double frame_s) : frame_s_(frame_s) {}

  [[nodiscard]] bool is_due(double now_s) const { return now_s >= due_s_; }

  //! A frame was begun.
  void begin(double now_s) { due_s_ = std::max(due_s_, now_s - 0.5 * frame_s_) + frame_s_; }

 private:
  double frame_s_;
  double due_s_ = -std::numeric_limits<double>::infinity();  //!< of the next frame
};

}  // namespace ergodome
