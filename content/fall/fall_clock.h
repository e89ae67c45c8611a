#pragma once

#include <optional>
#include <vector>

#include "content/fall/fall_settings.h"
#include "content/timeline/timeline.h"

namespace ergodome {

//! The own time of a falling camera as a function of the show's: the integral of its clock, which starts from rest, and comes to rest at the
//! fall's end.
class FallClock {
 public:
  //! `changing` has the clock's keys where it is animated, else it is nullptr; it is not kept.
  FallClock(const FallSettings& settings, const Animation* changing);

  //! The camera's own time since its fall began [M]; 0 before. Never falls.
  [[nodiscard]] double proper_time(double time_s) const;

  //! When the camera's own time comes to a value > 0 [s]; nothing where that is not before `end_s`.
  [[nodiscard]] std::optional<double> time_s(double proper_time, double end_s) const;

  //! Has the own time come to rest at a value > 0, smoothly.
  void stop_at(double proper_time);

 private:
  //! The clock from one time on, up to which the camera's own time has run to a value.
  struct Piece {
    double begin_s;
    double proper_time;
  };

  [[nodiscard]] double rate(double time_s) const;
  [[nodiscard]] double integral(double from_s, double to_s) const;
  [[nodiscard]] double unstopped(double time_s) const;

  double begin_s_;
  double end_s_;  //!< infinity where the fall does not end
  double ease_s_;
  Animation clock_;
  std::vector<Piece> pieces_;  //!< on each of them the clock is a polynomial
  std::optional<double> stop_;
  double stopping_ = 0.0;  //!< own time before the stop from which the clock slows down
};

}  // namespace ergodome
