#pragma once

#include "content/mesh/triangle_mesh.h"
#include "kernels/core/vector3.h"

namespace ergodome {

//! The corners of a triangle, and a texture on it: the first corner has (0, 0), the second (1, 0), the third (0, 1).
struct TriangleShape {
  std::array<Vector3<double>, 3> corners = {{{0.0, 0.0, 0.0}, {0.0, 1.0, 0.0}, {0.0, 0.0, 1.0}}};
};

//! A sphere of radius 1 by longitude and latitude, its poles on the z axis.
struct SphereShape {
  int segments = 36;  //!< of longitude
  int rings = 18;     //!< of latitude
};

//! A disk with a hole and a thickness about the z axis.
struct DiskShape {
  double inner = 6.6;
  double outer = 16.5;
  double thickness = 1.1;
  int segments = 64;  //!< round the axis
  int rings = 9;      //!< of each face
};

//! Limits of the numbers above.
inline constexpr int fewest_segments = 3;
inline constexpr int most_segments = 4096;
inline constexpr int most_rings = 4096;

//! One triangle, seen from both sides. Throws Error where it has no area.
TriangleMesh make_triangle(const TriangleShape& shape);

//! 2 segments (rings - 1) triangles; texture: u round the axis, v from the south pole to the north pole. Needs 2 rings or more.
TriangleMesh make_sphere(const SphereShape& shape);

//! 4 segments (rings + 1) triangles: the face towards +z red, the other blue, the edges green. Texture: u round the axis, v from the inner to
//! the outer edge, or across the edge.
TriangleMesh make_disk(const DiskShape& shape);

}  // namespace ergodome
