#pragma once

#include <array>

#include "kernels/core/vector3.h"

// Parameters of the built-in meshes (content/mesh/built_in_meshes.h).
namespace ergodome {

//! The corners of a triangle. Their texture coordinates are (0, 0), (1, 0) and (0, 1).
struct TriangleShape {
  std::array<Vector3<double>, 3> corners = {{{0.0, 0.0, 0.0}, {0.0, 1.0, 0.0}, {0.0, 0.0, 1.0}}};
};

//! A sphere of radius 1 divided by longitude and latitude, with its poles on the z axis.
struct SphereShape {
  int segments = 36;  //!< number of divisions in longitude
  int rings = 18;     //!< number of divisions in latitude
};

//! A disk with a hole and a thickness around the z axis.
struct DiskShape {
  double inner = 6.6;
  double outer = 16.5;
  double thickness = 1.1;
  int segments = 64;  //!< number of divisions around the axis
  int rings = 9;      //!< number of divisions of each face between its inner and outer edge
};

//! Minimum and maximum numbers of the segments and rings of built-in meshes.
inline constexpr int min_segments = 3;
inline constexpr int max_segments = 4096;
inline constexpr int max_rings = 4096;

}  // namespace ergodome
