#pragma once

#include <optional>
#include <vector>

#include "content/show/show.h"
#include "render/eyes/eye_camera.h"
#include "render/passes/objects/placed_meshes.h"

namespace ergodome {

//! A place that a head sees in some direction, on light's way to it.
struct NearSight {
  Vector3<double> place;  //!< pseudo-Cartesian [M]
  double distance;        //!< affine, from the head [M]
  bool first;             //!< of all places where that way meets the same thing
  bool opaque;            //!< next to nothing is seen through the thing
};

//! What of a show's disk and shells a head sees in a direction of its view, the nearest first, up to what is opaque. Double rays.
std::vector<NearSight> near_sights(const Show& show, const EyeCamera& head, const Vector3<double>& view);

//! The affine distance from a head of the first of some meshes that it sees in a direction of its view [M]; infinite where it sees none. Double rays.
double distance_of_objects(const PlacedMeshes& meshes, const EyeCamera& head, const Vector3<double>& view);

//! The affine distance from a head of a place that it sees in a direction of its view [M]; nothing where light from there does not pass by the place.
std::optional<double> distance_of_place(const EyeCamera& head, const Vector3<double>& view,
                                        const Vector3<double>& place);

}  // namespace ergodome
