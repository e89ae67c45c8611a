#pragma once

#include "content/mesh/triangle_mesh.h"
#include "content/objects/object_motion.h"
#include "render/passes/objects/polygons/connection_textures.h"

namespace ergodome {

//! Returns the range of radii of a mesh at a placement [M]. `radius` is radius_of(mesh) times the
//! size. Exact if the bounding sphere comes near the hole, otherwise that of the sphere.
RadialRange radial_range(const TriangleMesh& mesh, const ObjectPlacement& placement, double size, double radius);

//! Returns the distance of a triangle from the origin.
double distance_from_origin(const Vector3<double>& a, const Vector3<double>& b, const Vector3<double>& c);

}  // namespace ergodome
