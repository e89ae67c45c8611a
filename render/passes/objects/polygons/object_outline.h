#pragma once

#include <span>
#include <vector>

#include "content/mesh/triangle_mesh.h"
#include "content/objects/object_motion.h"

namespace ergodome {

//! Triangles of a mesh, three corners each, in the mesh's unit, for computing distances. Large
//! meshes are subsampled.
using MeshOutline = std::vector<Vector3<double>>;

//! Returns an outline of about two thousand triangles at most. Skips triangles with non-finite
//! corners.
MeshOutline outline_of(const TriangleMesh& mesh);

//! Outline of an object in space at an instant.
struct PlacedOutline {
  std::vector<Vector3<double>> corners;  //!< of triangles, pseudo-Cartesian [M]
  ObjectPlacement placement;
  bool retarded = false;  //!< light shows the object at its position when the light was emitted

  //! Returns the position at which light with a travel time [M] shows a point of the object.
  [[nodiscard]] Vector3<double> seen(const Vector3<double>& place, double travel_time) const;
};

//! A visible point near the hole, on an object that may move during the light travel time, or at
//! rest.
struct SeenThing {
  Vector3<double> place;                  //!< pseudo-Cartesian, at the time of the camera [M]
  const PlacedOutline* object = nullptr;  //!< object that it belongs to; nullptr if at rest

  //! Returns the position at which light with a travel time [M] shows the point.
  [[nodiscard]] Vector3<double> at(double travel_time) const {
    return object != nullptr ? object->seen(place, travel_time) : place;
  }
  [[nodiscard]] bool moves() const { return object != nullptr && object->retarded; }
};

//! Returns the outlines of a show's objects, one each, at a show time.
std::vector<PlacedOutline> place_outlines(const std::vector<ObjectSettings>& objects,
                                          std::span<const MeshOutline> outlines, double time_s);

//! Returns the point of a triangle that is nearest to `point`.
Vector3<double> nearest_of_triangle(const Vector3<double>& point, std::span<const Vector3<double>, 3> corners);

}  // namespace ergodome
