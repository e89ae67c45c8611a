#pragma once

#include <vector>

#include "kernels/core/vector3.h"

namespace ergodome {

//! Computes the path of light from a point to an observer, for the ray of an image order (1 is the
//! direct image), around a hole without spin. Returns pseudo-Cartesian positions from the point to
//! the observer [M]. Their inverse radius u = 1/r is accurate to about 1e-12, and they are dense
//! enough to be connected by straight lines. Returns nothing if there is no such ray
//! (why_not_connected()).
std::vector<Vector3<double>> light_curve(const Vector3<double>& observer, const Vector3<double>& point, int order);

}  // namespace ergodome
