#pragma once

#include <optional>

#include "kernels/spacetime/kerr/observer.h"

namespace ergodome {

//! A camera that its path lets go of: from then on nothing but gravity moves it.
struct FallSettings {
  double time_s = 0.0;                           //!< when it begins: there is a key of the camera then
  ObserverMotion motion = ObserverMotion::zamo;  //!< the velocity at which it begins, as that of an observer
  Vector3<double> velocity = {0.0, 0.0, 0.0};    //!< in the ZAMO frame, for ObserverMotion::velocity
  double clock = 0.0;                            //!< the camera's own time in a second of the show [M/s]
  //! The velocity is taken on so long before, and the clock so long after; the other way round at its end [s].
  double ease_s = 1.0;
  double least_r = 0.0;           //!< where time comes to rest [M], within the horizon too; 0: nowhere
  std::optional<double> until_s;  //!< when it ends, 2 ease_s or more after it began; absent: with the show
};

//! Whether it is the fall that places the camera at a time: keys then say but where it looks.
inline bool falls_at(const FallSettings& fall, double time_s) {
  return time_s > fall.time_s && !(fall.until_s && time_s > *fall.until_s);
}

}  // namespace ergodome
