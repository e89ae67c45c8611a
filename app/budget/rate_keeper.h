#pragma once

#include <cstddef>
#include <deque>
#include <vector>

namespace ergodome {

//! Holds a rate of frames: sees what each frame took, and says which rung of a ladder the next one is drawn on. It knows no clock.
//!
//! It goes one rung down (quicker) when the median of the last frames takes too much of a frame's time; one slow frame alone moves nothing. It
//! goes one rung up when frames were quick enough for long enough that the finer rung would fit by the foretold ratio. Where a rung that was
//! tried proves too slow, it waits twice as long before it is tried again, so that a machine that lies between two rungs does not swing.
class RateKeeper {
 public:
  //! `rung_ms`: foretold times of the ladder's rungs, falling; NaN: not known. `frame_ms`: time of a frame at the rate.
  RateKeeper(std::vector<double> rung_ms, double frame_ms, std::size_t first);

  //! A frame on the rung in use took `work_ms` to draw, and came `interval_ms` after the last one.
  void note(double work_ms, double interval_ms);

  [[nodiscard]] std::size_t rung() const { return rung_; }
  //! How often the rung was changed.
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
  std::deque<double> work_ms_;      //!< on this rung, the latest last
  std::deque<double> interval_ms_;  //!< the same
  long frames_here_ = 0;            //!< on this rung
  long frames_quick_ = 0;           //!< in a row, of which the finer rung would hold the rate
  long patience_;                   //!< how many of them are waited for
  bool trying_ = false;             //!< this rung was gone up to, and is not proven yet
  long changes_ = 0;
};

}  // namespace ergodome
