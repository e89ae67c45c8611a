#pragma once

#include <cmath>
#include <random>
#include <vector>

#include "kernels/core/angles.h"
#include "kernels/core/vector3.h"

// Pairs of a point and a lamp around a hole, for tests of the light of lamps.
namespace ergodome::test {

//! Converts spherical coordinates of a point to pseudo-Cartesian ones.
inline Vector3<double> point_at(double r, double theta, double phi) {
  return {r * std::sin(theta) * std::cos(phi), r * std::sin(theta) * std::sin(phi), r * std::cos(theta)};
}

//! A point on a surface, and a lamp.
struct LitPoint {
  Vector3<double> point, lamp;
};

//! Returns forty pairs of a point and a lamp, at random positions around a hole.
inline std::vector<LitPoint> lit_points() {
  std::mt19937 random(11);
  std::uniform_real_distribution<double> share(0.0, 1.0);
  const auto position = [&](double minimum, double maximum) {
    return point_at(minimum + (maximum - minimum) * share(random), std::acos(2.0 * share(random) - 1.0),
                    2.0 * pi * share(random));
  };
  std::vector<LitPoint> points;
  for (int i = 0; i < 40; ++i) {
    const Vector3<double> point = position(3.5, 20.0);
    points.push_back({point, position(3.5, 60.0)});
  }
  return points;
}

}  // namespace ergodome::test
