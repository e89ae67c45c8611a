#pragma once

#include <cmath>

#include "kernels/core/vector3.h"

namespace ergodome {

//! A velocity below that of light [c], times its Lorentz factor: of any length. Whatever lies between two of them belongs to a velocity below
//! that of light again, and two that are apart by some length show directions apart by less than twice that angle [rad].
inline Vector3<double> proper_velocity(const Vector3<double>& velocity) {
  return (1.0 / std::sqrt(1.0 - dot(velocity, velocity))) * velocity;
}

//! The velocity that a proper one belongs to.
inline Vector3<double> velocity_of_proper(const Vector3<double>& proper) {
  return (1.0 / std::sqrt(1.0 + dot(proper, proper))) * proper;
}

}  // namespace ergodome
