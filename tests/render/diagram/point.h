#pragma once

#include <cmath>

#include "kernels/core/vector3.h"

namespace ergodome::test {

//! A point in pseudo-Cartesian coordinates [M].
using Point = Vector3<double>;

inline double length_of(const Point& v) { return std::sqrt(dot(v, v)); }

}  // namespace ergodome::test
