#pragma once

#include <cstddef>
#include <deque>
#include <vector>

namespace ergodome {

//! Holds a frame rate: receives the time of each frame and selects the rung of a ladder for the
//! next one. Has no clock.
//!
//! Goes one rung down (faster) if the median of the last frames takes too much of the frame time; a
//! single slow frame changes nothing. Goes one rung up if frames were fast enough for long enough
//! that the finer rung would fit by the predicted ratio. If that rung proves too slow, the waiting
//! time before the next attempt doubles, so that the rate does not oscillate between two rungs.
class RateKeeper {
 public:
  //! `rung_ms`: predicted times of the rungs, decreasing; NaN: unknown. `frame_ms`: frame time at
  //! the requested rate.
  RateKeeper(std::vector<double> rung_ms, double frame_ms, std::size_t first);

  //! Records that a frame on the current rung took `work_ms` to draw and came `interval_ms` after
  //! the last one.
  void note(double work_ms, double interval_ms);

  [[nodiscard]] std::size_t rung() const { return rung_; }
  //! Returns the number of rung changes.
  [[nodiscard]] long changes() const { return changes_; }

 private:
  [[nodiscard]] bool is_too_slow() const;
  [[nodiscard]] bool finer_would_fit() const;
  [[nodiscard]] double finer_ratio() const;
  void go_to(std::size_t rung);
  void go_down();
  void go_up();

  std::vector<double> rung_ms_;
  double frame_ms_;
  std::size_t rung_;
  std::deque<double> work_ms_;      //!< on this rung; the latest is last
  std::deque<double> interval_ms_;  //!< on this rung; the latest is last
  long frames_here_ = 0;            //!< on this rung
  long frames_quick_ = 0;           //!< consecutive frames so fast that the finer rung would fit
  long patience_;                   //!< number of such frames to wait for
  bool trying_ = false;             //!< this rung was reached from below and is not proven yet
  long changes_ = 0;
};

}  // namespace ergodome
