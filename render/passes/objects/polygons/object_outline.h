#pragma once

#include <span>
#include <vector>

#include "content/mesh/triangle_mesh.h"
#include "content/objects/object_motion.h"

namespace ergodome {

//! Some or all triangles of a mesh, three corners each, in the mesh's unit; used to compute
//! distances. Large meshes are subsampled.
using MeshOutline = std::vector<Vector3<double>>;

//! Returns an outline of about two thousand triangles at most. Skips triangles with non-finite
//! corners.
MeshOutline outline_of(const TriangleMesh& mesh);

//! Outline of an object in space at an instant.
struct PlacedOutline {
  std::vector<Vector3<double>> corners;  //!< corners of triangles, pseudo-Cartesian [M]
  ObjectPlacement placement;
  //! True: the object is seen at its position at the time when the light left it.
  bool retarded = false;

  //! Returns the position at which an observer sees the point `position` of the object, if its
  //! light travels for `travel_time` [M].
  [[nodiscard]] Vector3<double> seen(const Vector3<double>& position, double travel_time) const;
};

//! A point near the hole that eyes see: on an object, which may move during the light travel time,
//! or at rest.
struct SeenThing {
  //! Position at the time of the camera, pseudo-Cartesian [M].
  Vector3<double> position;
  //! Object to which the point belongs; nullptr for a point at rest.
  const PlacedOutline* object = nullptr;

  //! Returns the position at which the point is seen, if its light travels for `travel_time` [M].
  [[nodiscard]] Vector3<double> at(double travel_time) const {
    return object != nullptr ? object->seen(position, travel_time) : position;
  }
  [[nodiscard]] bool moves() const { return object != nullptr && object->retarded; }
};

//! Returns the outline of each of a show's objects at a show time.
std::vector<PlacedOutline> place_outlines(const std::vector<ObjectSettings>& objects,
                                          std::span<const MeshOutline> outlines, double time_s);

//! Returns the point of a triangle that is nearest to `point`.
Vector3<double> nearest_of_triangle(const Vector3<double>& point, std::span<const Vector3<double>, 3> corners);

}  // namespace ergodome
