#pragma once

#include <optional>
#include <vector>

#include "content/show/fall_settings.h"
#include "content/timeline/timeline.h"

namespace ergodome {

//! The proper time of a falling camera as a function of show time: the integral of its clock rate,
//! which rises smoothly from 0 when the fall begins. If the fall has an end, the rate falls
//! smoothly to 0 there.
class FallClock {
 public:
  //! `changing` contains the keys of an animated clock rate, else it is nullptr; it is copied.
  FallClock(const FallSettings& settings, const Animation* changing);

  //! Returns the camera's proper time since its fall began [M]; 0 before. Never decreases.
  [[nodiscard]] double proper_time(double time_s) const;

  //! Returns the show time when the camera's proper time reaches `proper_time`, which is positive
  //! [s]; nothing if that happens later than `end_s` or never.
  [[nodiscard]] std::optional<double> time_s(double proper_time, double end_s) const;

  //! Makes the clock slow down smoothly and stop at a positive proper time [M].
  void stop_at(double proper_time);

 private:
  //! The beginning of an interval of show time, with the proper time up to there [M].
  struct Piece {
    double begin_s;
    double proper_time;
  };

  [[nodiscard]] double rate(double time_s) const;
  [[nodiscard]] double integral(double from_s, double to_s) const;
  [[nodiscard]] double unstopped(double time_s) const;

  double begin_s_;
  double end_s_;  //!< end of the fall; infinite if the fall does not end
  double ease_s_;
  Animation clock_;
  //! Intervals of show time, on each of which the clock rate is a polynomial.
  std::vector<Piece> pieces_;
  std::optional<double> stop_;
  //! Proper time from the moment when the clock begins to slow down to its stop at `stop_` [M].
  double stopping_ = 0.0;
};

}  // namespace ergodome
