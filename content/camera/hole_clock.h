#pragma once

#include <memory>
#include <vector>

#include "content/camera/free_fall.h"

namespace ergodome {

//! The hole's time as a function of show time; it drives the clouds of a disk.
//!
//! Without a fall it advances by a constant number of M per second of the show. In a fall, the
//! camera's clock defines how much proper time passes per second, and the orbit defines how much
//! time of the hole passes per proper time; what the camera sees then runs fast or slow by the
//! redshift factor g. During FallSettings::ease_s after the fall's beginning and before its end,
//! the rate without a fall changes to that of the fall and back.
//!
//! The hole's time is Boyer-Lindquist time, or for a fall through the horizon the time of infalling
//! observers (ingoing_lag()).
class HoleClock {
 public:
  //! `orbit` is that of the show's camera, or nullptr if it does not fall; `pace` is the rate
  //! without a fall [M/s].
  HoleClock(Spacetime spacetime, std::shared_ptr<const FreeFall> orbit, double pace);

  //! Returns the hole's time at a show time, from 0 at the show's beginning [M].
  [[nodiscard]] double time(double time_s) const;

 private:
  struct Station {
    double proper_time;  //!< [M]
    OrbitState state;
  };

  void follow();
  [[nodiscard]] double time_along_orbit(double time_s) const;

  Spacetime spacetime_;
  std::shared_ptr<const FreeFall> orbit_;
  double pace_;
  OrbitConstants constants_{};
  std::vector<Station> stations_;
};

}  // namespace ergodome
