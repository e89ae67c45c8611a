#pragma once

#include <cmath>

#include "kernels/spacetime/shadow/shadow_chart.h"
#include "tests/hard_cases/hard_case.h"

namespace ergodome::test {

//! Returns directions in a square window of the camera's sky, row by row. The window is centered at
//! `middle`, is `across` wide [rad] and has `side_px` directions per row.
inline Directions square_window(const Vector3<double>& middle, double across, int side_px) {
  const Vector3<double> up =
      std::abs(middle.y) < 0.9 ? Vector3<double>{0.0, -1.0, 0.0} : Vector3<double>{1.0, 0.0, 0.0};
  const Vector3<double> right = normalized(cross(middle, up));
  const Vector3<double> top = cross(right, middle);
  const double half = std::tan(0.5 * across);
  Directions all;
  for (int y = 0; y < side_px; ++y) {
    for (int x = 0; x < side_px; ++x) {
      const double h = half * (2.0 * (x + 0.5) / side_px - 1.0);
      const double v = half * (1.0 - 2.0 * (y + 0.5) / side_px);
      all.push_back(normalized(middle + h * right + v * top));
    }
  }
  return all;
}

}  // namespace ergodome::test
