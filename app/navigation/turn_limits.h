#pragma once

#include <algorithm>
#include <cmath>

#include "content/show/flight_settings.h"
#include "kernels/core/angles.h"

namespace ergodome {

//! How the limits of comfort are shared between turning the head and going around the hole, in radians.
struct TurnLimits {
  double total;         //!< fastest turn of the view [rad/s]
  double head;          //!< by looking around [rad/s]
  double around;        //!< by going around [rad/s]
  double acceleration;  //!< [rad/s²]
};

//! Both together stay within the show's limits. Two turns about axes that turn each other change by their product: where little
//! acceleration is allowed, the turns are slow enough for that to be a part of it.
inline TurnLimits turn_limits(const ComfortSettings& comfort) {
  const double acceleration = one_degree * comfort.turn_accel_deg_s2;
  const double total = std::min(one_degree * comfort.turn_deg_s, std::sqrt(acceleration / 1.28));
  return {one_degree * comfort.turn_deg_s, 0.6 * total, 0.4 * total, acceleration};
}

}  // namespace ergodome
