#pragma once

#include "content/mesh/triangle_mesh.h"

namespace ergodome {

//! Gives corners whose normal is zero, or no number, that of the faces that meet in them, weighted by their areas: where no face shares a corner, the face's own.
void repair_normals(TriangleMesh& mesh);

}  // namespace ergodome
