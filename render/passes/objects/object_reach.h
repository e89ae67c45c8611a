#pragma once

#include "content/mesh/triangle_mesh.h"
#include "content/objects/object_motion.h"
#include "render/passes/objects/polygons/connection_textures.h"

namespace ergodome {

//! Returns the minimum and maximum distance from the hole's center of a mesh at a placement [M]:
//! those of its bounding sphere, but the exact minimum if the sphere extends inside
//! nearest_of_objects. `radius`: radius_of(mesh) times the size.
RadialRange radial_range(const TriangleMesh& mesh, const ObjectPlacement& placement, double size, double radius);

//! Returns the distance of the triangle (a, b, c) from the origin.
double distance_from_origin(const Vector3<double>& a, const Vector3<double>& b, const Vector3<double>& c);

}  // namespace ergodome
