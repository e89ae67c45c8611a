#pragma once

#include "kernels/metric/observer.h"

namespace ergodome {

//! A camera that its path lets go of: from then on nothing but gravity moves it.
struct FallSettings {
  double time_s = 0.0;                           //!< when it begins: there is a key of the camera then
  ObserverMotion motion = ObserverMotion::zamo;  //!< the velocity at which it begins, as that of an observer
  Vector3<double> velocity = {0.0, 0.0, 0.0};    //!< in the ZAMO frame, for ObserverMotion::velocity
  double clock = 0.0;                            //!< the camera's own time in a second of the show [M/s]
  double ease_s = 1.0;   //!< the velocity is taken on so long before, and the clock so long after
  double least_r = 0.0;  //!< where time comes to rest [M]; 0: nowhere
};

}  // namespace ergodome
