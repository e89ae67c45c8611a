#pragma once

#include <memory>
#include <vector>

#include "content/fall/free_fall.h"

namespace ergodome {

//! The hole's time as a show runs: that by which the clouds of a disk turn.
//!
//! Without a fall a second of the show has as many M of it as it is told. In a fall the camera's clock says how much own time a second has, and the
//! orbit how much of the hole's time goes by in it, which then is what a clock far away would tell of the camera: what is seen runs fast or slow by g. In
//! FallSettings::ease_s after the fall's beginning and before its end the one rate goes over to the other.
//!
//! The hole's time is Boyer-Lindquist's, but that of who falls in (ingoing_lag()) of a fall that leads through the horizon.
class HoleClock {
 public:
  //! `orbit` is that of a show's camera, nullptr where it does not fall; `pace` [M/s] is the rate without it.
  HoleClock(double spin, std::shared_ptr<const FreeFall> orbit, double pace);

  //! The hole's time at a show time, 0 at the show's beginning [M].
  [[nodiscard]] double time(double time_s) const;

 private:
  struct Station {
    double proper_time;  //!< [M]
    OrbitState state;
  };

  void follow();
  [[nodiscard]] double time_along_orbit(double time_s) const;

  double spin_;
  std::shared_ptr<const FreeFall> orbit_;
  double pace_;
  OrbitConstants constants_{};
  std::vector<Station> stations_;
};

}  // namespace ergodome
