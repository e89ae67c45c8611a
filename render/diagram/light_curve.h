#pragma once

#include <vector>

#include "kernels/core/vector3.h"

namespace ergodome {

//! The way that light takes from a point to an observer on the ray of an image, 1 and up, about a hole without spin: pseudo-Cartesian places, from
//! the point to the observer [M]. They lie on the orbit to some 1e-12 of u, and so close that straight lines between them pass for it.
//! Nothing where there is no such ray (why_not_connected).
std::vector<Vector3<double>> light_curve(const Vector3<double>& observer, const Vector3<double>& point, int order);

}  // namespace ergodome
