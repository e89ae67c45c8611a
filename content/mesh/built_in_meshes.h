#pragma once

#include "content/mesh/mesh_shapes.h"
#include "content/mesh/triangle_mesh.h"

namespace ergodome {

//! Returns a mesh of one triangle. Throws Error if its corners are on one line.
TriangleMesh make_triangle(const TriangleShape& shape);

//! Returns a sphere of 2 · segments · (rings - 1) triangles. Texture: u around the axis, v from the
//! south pole to the north pole. Needs at least 2 rings.
TriangleMesh make_sphere(const SphereShape& shape);

//! Returns a disk of 4 · segments · (rings + 1) triangles: its face toward +z is red, the other
//! blue, the edges green. Texture: u around the axis; v from the inner to the outer edge on faces,
//! from -z to +z on edges.
TriangleMesh make_disk(const DiskShape& shape);

}  // namespace ergodome
