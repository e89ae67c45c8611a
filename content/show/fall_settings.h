#pragma once

#include <optional>

#include "kernels/spacetime/kerr/observer.h"

namespace ergodome {

//! Free fall of the camera: from the given time on, only gravity moves it.
struct FallSettings {
  //! Beginning of the fall; the camera has a key at this time.
  double time_s = 0.0;
  ObserverMotion motion = ObserverMotion::zamo;  //!< the initial velocity is that of this observer
  //! Initial velocity in the ZAMO frame, for ObserverMotion::velocity.
  Vector3<double> velocity = {0.0, 0.0, 0.0};
  double clock = 0.0;  //!< the camera's proper time per second of the show [M/s]
  //! Duration of each transition [s]. Before the fall, the velocity changes to the fall's initial
  //! one; after its beginning, the clock accelerates to its rate. At the end, the clock slows down
  //! before it, and the velocity changes back after it.
  double ease_s = 1.0;
  //! Radius at which the camera's clock stops, also inside the horizon [M]; 0: none.
  double least_r = 0.0;
  std::optional<double> until_s;  //!< end, at least 2 ease_s after the beginning; absent: with the show
};

//! Returns true if the fall defines the camera's position at a time; keys then only define its
//! orientation.
inline bool falls_at(const FallSettings& fall, double time_s) {
  return time_s > fall.time_s && !(fall.until_s && time_s > *fall.until_s);
}

}  // namespace ergodome
