#pragma once

#include <algorithm>
#include <cstddef>
#include <deque>
#include <limits>
#include <vector>

namespace ergodome {

//! Holds a frame rate: receives the time of each frame and selects the rung of a ladder for the
//! next one. Reads no clock: callers pass the times.
//!
//! Goes one rung down (faster) if the median drawing time of the last frames takes too much of the
//! frame time, or if they come late; a single slow frame changes nothing. Goes one rung up once
//! drawing times, scaled by the predicted ratio of the finer rung, have fitted for long enough. If
//! that rung proves too slow, the waiting time before the next attempt doubles, so that the rate
//! does not oscillate between two rungs.
class RateKeeper {
 public:
  //! `rung_ms`: predicted times of the rungs, decreasing; NaN: unknown. `frame_ms`: frame time at
  //! the requested rate. `first`: index of the rung to start with.
  RateKeeper(std::vector<double> rung_ms, double frame_ms, std::size_t first);

  //! Records that a frame on the current rung took `work_ms` to draw and came `interval_ms` after
  //! the last one, and selects the rung for the next. Ignores the times of a rung's first frame.
  void note(double work_ms, double interval_ms);

  [[nodiscard]] std::size_t rung() const { return rung_; }
  //! Returns the number of rung changes.
  [[nodiscard]] long changes() const { return changes_; }

 private:
  [[nodiscard]] bool is_too_slow() const;
  [[nodiscard]] bool finer_would_fit() const;
  [[nodiscard]] double finer_ratio() const;
  void use_rung(std::size_t rung);
  void step_down();
  void step_up();

  std::vector<double> rung_ms_;
  double frame_ms_;
  std::size_t rung_;
  //! Drawing times of the last frames on this rung; the latest is last.
  std::deque<double> work_ms_;
  //! Intervals between the last frames on this rung; the latest is last.
  std::deque<double> interval_ms_;
  long frames_here_ = 0;   //!< number of frames on this rung
  long frames_quick_ = 0;  //!< consecutive frames so fast that the finer rung would fit
  long patience_;          //!< the finer rung is tried once frames_quick_ exceeds this
  bool trying_ = false;    //!< this rung was reached by a step up and is not proven fast enough yet
  long changes_ = 0;
};

//! Statistics of the achieved frame rate, over consecutive frames while something moved.
class RateRecord {
 public:
  explicit RateRecord(double frame_ms) : frame_ms_(frame_ms) {}

  void note(double interval_ms) {
    ++frames_;
    sum_ms_ += interval_ms;
    late_ += interval_ms > late_share * frame_ms_ ? 1 : 0;
    longest_ms_ = std::max(longest_ms_, interval_ms);
  }

  [[nodiscard]] long frames() const { return frames_; }
  //! Returns the mean rate [Hz]; 0 before the first frame.
  [[nodiscard]] double rate_hz() const { return frames_ > 0 ? 1000.0 * static_cast<double>(frames_) / sum_ms_ : 0.0; }
  //! Returns the fraction of frames whose interval is longer than 1.5 frame times.
  [[nodiscard]] double late() const {
    return frames_ > 0 ? static_cast<double>(late_) / static_cast<double>(frames_) : 0.0;
  }
  [[nodiscard]] double longest_ms() const { return longest_ms_; }

 private:
  static constexpr double late_share = 1.5;

  double frame_ms_;
  long frames_ = 0;
  long late_ = 0;
  double sum_ms_ = 0.0;
  double longest_ms_ = 0.0;
};

//! Schedules frames at a fixed rate, by a monotonic clock [s]. Up to half a frame of lateness is
//! made up for by later frames, so that the mean rate holds; more is lost.
class FramePace {
 public:
  explicit FramePace(double frame_s) : frame_s_(frame_s) {}

  [[nodiscard]] bool is_due(double now_s) const { return now_s >= due_s_; }

  //! Records the start of a frame, and sets when the next one is due.
  void begin(double now_s) { due_s_ = std::max(due_s_, now_s - 0.5 * frame_s_) + frame_s_; }

 private:
  double frame_s_;
  double due_s_ = -std::numeric_limits<double>::infinity();  //!< when the next frame is due
};

}  // namespace ergodome
