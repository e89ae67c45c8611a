#pragma once

#include <algorithm>
#include <array>

#include "kernels/stars/search/bezier_patch.h"

// Builds bicubic patches from maps of the unit square.
namespace ergodome::test {

//! Computes the control points of a cubic Bézier curve that has the values `at` at the parameters
//! 0, 1/3, 2/3 and 1.
inline void control_from_thirds(const double (&at)[4], double (&points)[4]) {
  points[0] = at[0];
  points[1] = (-5.0 * at[0] + 18.0 * at[1] - 9.0 * at[2] + 2.0 * at[3]) / 6.0;
  points[2] = (2.0 * at[0] - 9.0 * at[1] + 18.0 * at[2] - 5.0 * at[3]) / 6.0;
  points[3] = at[3];
}

//! Returns a bicubic patch over [0, 1]² that interpolates 16 points of a map. The map's points are
//! in the plane z = 1.
template <class Map>
BezierPatch patch_of(const Map& map) {
  BezierPatch patch{};
  for (int part = 0; part < 2; ++part) {
    double rows[4][4];
    for (int row = 0; row < 4; ++row) {
      double at[4];
      for (int column = 0; column < 4; ++column) {
        at[column] = map(column / 3.0, row / 3.0)[part];
      }
      control_from_thirds(at, rows[row]);
    }
    for (int column = 0; column < 4; ++column) {
      const double at[4] = {rows[0][column], rows[1][column], rows[2][column], rows[3][column]};
      double points[4];
      control_from_thirds(at, points);
      for (int row = 0; row < 4; ++row) {
        (part == 0 ? patch.x : patch.y)[4 * row + column] = static_cast<float>(points[row]);
      }
    }
  }
  std::fill_n(patch.z, 16, 1.0F);
  return patch;
}

}  // namespace ergodome::test
