#pragma once

#include <cmath>

#include "kernels/core/vector3.h"

namespace ergodome {

//! Returns a velocity below that of light [c] times its Lorentz factor. Proper velocities have any
//! length, so values interpolated between them also correspond to velocities below that of light.
//! Two observers whose proper velocities differ by some length see directions that differ by less
//! than twice that angle [rad].
inline Vector3<double> proper_velocity(const Vector3<double>& velocity) {
  return (1.0 / std::sqrt(1.0 - dot(velocity, velocity))) * velocity;
}

//! Returns the velocity that corresponds to a proper velocity.
inline Vector3<double> velocity_of_proper(const Vector3<double>& proper) {
  return (1.0 / std::sqrt(1.0 + dot(proper, proper))) * proper;
}

}  // namespace ergodome
