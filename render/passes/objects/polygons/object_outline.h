#pragma once

#include <span>
#include <vector>

#include "content/mesh/triangle_mesh.h"
#include "content/objects/object_motion.h"

namespace ergodome {

//! Triangles of a mesh, three corners each, in its own unit: what tells how near it comes. Of many there is every so-many-th.
using MeshOutline = std::vector<Vector3<double>>;

//! Some two thousand triangles at the most; such as have corners that are no numbers are left out.
MeshOutline outline_of(const TriangleMesh& mesh);

//! An object's outline in space at an instant.
struct PlacedOutline {
  std::vector<Vector3<double>> corners;  //!< of triangles, pseudo-Cartesian [M]
  ObjectPlacement placement;
  bool retarded = false;  //!< light shows the object where it was when the light left it

  //! Where a place of it was seen to be, by light that has been on its way for so long [M].
  [[nodiscard]] Vector3<double> seen(const Vector3<double>& place, double travel_time) const;
};

//! A place near the hole that is seen; of an object that may move while its light is on the way, or of something at rest.
struct SeenThing {
  Vector3<double> place;                  //!< pseudo-Cartesian, as the camera looks [M]
  const PlacedOutline* object = nullptr;  //!< that it is of

  //! Where light that has been on its way for so long shows it [M].
  [[nodiscard]] Vector3<double> at(double travel_time) const {
    return object != nullptr ? object->seen(place, travel_time) : place;
  }
  [[nodiscard]] bool moves() const { return object != nullptr && object->retarded; }
};

//! Puts the outlines of a show's objects, one each, where the objects are at a show time.
std::vector<PlacedOutline> place_outlines(const std::vector<ObjectSettings>& objects,
                                          std::span<const MeshOutline> outlines, double time_s);

//! The place of a triangle that is nearest to a point.
Vector3<double> nearest_of_triangle(const Vector3<double>& point, std::span<const Vector3<double>, 3> corners);

}  // namespace ergodome
