#pragma once

#include <algorithm>
#include <cmath>

#include "content/show/flight_settings.h"
#include "kernels/core/angles.h"

namespace ergodome {

//! Limits of comfort, divided between looking around and going around the hole.
struct TurnLimits {
  double total;         //!< maximum rotation rate of the view [rad/s]
  double head;          //!< maximum rotation rate for looking around [rad/s]
  double around;        //!< maximum rotation rate for going around the hole [rad/s]
  double acceleration;  //!< maximum angular acceleration [rad/s²]
};

//! Divides the show's limits so that both motions together stay within them. Two rotations about
//! axes that rotate each other change by their product; with a small acceleration limit, rotations
//! are slow enough for that product to be a part of it.
inline TurnLimits turn_limits(const ComfortSettings& comfort) {
  const double acceleration = one_degree * comfort.turn_accel_deg_s2;
  const double total = std::min(one_degree * comfort.turn_deg_s, std::sqrt(acceleration / 1.28));
  return {one_degree * comfort.turn_deg_s, 0.6 * total, 0.4 * total, acceleration};
}

}  // namespace ergodome
