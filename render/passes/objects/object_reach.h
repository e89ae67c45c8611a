#pragma once

#include "content/mesh/triangle_mesh.h"
#include "content/objects/object_motion.h"
#include "render/passes/objects/polygons/connection_textures.h"

namespace ergodome {

//! Between which radii a mesh lies at a placement [M]; `radius` is radius_of(mesh) times its size. Exact where the ball of that radius comes near the
//! hole, else that of the ball.
RadialRange radial_range(const TriangleMesh& mesh, const ObjectPlacement& placement, double size, double radius);

//! Distance of a triangle from the origin.
double distance_from_origin(const Vector3<double>& a, const Vector3<double>& b, const Vector3<double>& c);

}  // namespace ergodome
