#pragma once

#include "content/mesh/triangle_mesh.h"

namespace ergodome {

//! Replaces normals that are zero or non-finite by the mean normal of the faces that share the
//! vertex, weighted by area. A vertex of a single face gets the face's normal.
void repair_normals(TriangleMesh& mesh);

}  // namespace ergodome
