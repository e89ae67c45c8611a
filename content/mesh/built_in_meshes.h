#pragma once

#include "content/mesh/mesh_shapes.h"
#include "content/mesh/triangle_mesh.h"

namespace ergodome {

//! One triangle, seen from both sides. Throws Error where it has no area.
TriangleMesh make_triangle(const TriangleShape& shape);

//! 2 segments (rings - 1) triangles; texture: u round the axis, v from the south pole to the north pole. Needs 2 rings or more.
TriangleMesh make_sphere(const SphereShape& shape);

//! 4 segments (rings + 1) triangles: the face towards +z red, the other blue, the edges green. Texture: u round the axis, v from the inner to
//! the outer edge, or across the edge.
TriangleMesh make_disk(const DiskShape& shape);

}  // namespace ergodome
