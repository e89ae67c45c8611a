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

//! Divides the show's limits so that both motions together stay within them. If two rotations turn
//! each other's axes, the product of their rates is an angular acceleration. With a small
//! acceleration limit, the rates are limited so that this product is only a part of it.
inline TurnLimits turn_limits(const ComfortSettings& comfort) {
  const double acceleration = one_degree * comfort.turn_accel_deg_s2;
  const double total = std::min(one_degree * comfort.turn_deg_s, std::sqrt(acceleration / 1.28));
  return {one_degree * comfort.turn_deg_s, 0.6 * total, 0.4 * total, acceleration};
}

}  // namespace ergodome
