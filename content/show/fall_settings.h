#pragma once

#include <optional>

#include "kernels/spacetime/kerr/observer.h"

namespace ergodome {

//! Free fall of the camera: from the given time on, only gravity moves it.
struct FallSettings {
  double time_s = 0.0;                           //!< when it begins; the camera has a key then
  ObserverMotion motion = ObserverMotion::zamo;  //!< initial velocity, as that of an observer
  Vector3<double> velocity = {0.0, 0.0, 0.0};    //!< in the ZAMO frame, for ObserverMotion::velocity
  double clock = 0.0;                            //!< the camera's proper time per second of the show [M/s]
  //! Duration of the change to the fall's velocity before it, and of the clock's start after that;
  //! the reverse at the end [s].
  double ease_s = 1.0;
  double least_r = 0.0;           //!< radius at which time stops, also inside the horizon [M]; 0: none
  std::optional<double> until_s;  //!< end, at least 2 ease_s after the beginning; absent: with the show
};

//! Returns true if the fall defines the camera's position at a time; keys then only define its
//! orientation.
inline bool falls_at(const FallSettings& fall, double time_s) {
  return time_s > fall.time_s && !(fall.until_s && time_s > *fall.until_s);
}

}  // namespace ergodome
