#pragma once

#include <optional>
#include <vector>

#include "content/show/show.h"
#include "render/eyes/eye_camera.h"
#include "render/passes/objects/placed_meshes.h"

// Finds the points of disk, shells and objects in a direction.

namespace ergodome {

//! A point that a head sees in some direction, on the path of the light.
struct NearSight {
  Vector3<double> place;  //!< pseudo-Cartesian [M]
  double distance;        //!< affine, from the head [M]
  bool first;             //!< first meeting of that light path with the same thing
  bool opaque;            //!< the thing is almost opaque
};

//! Returns the points of a show's disk and shells that a head sees in a direction of its view,
//! nearest first, up to the first opaque one. Uses double rays.
std::vector<NearSight> near_sights(const Show& show, const EyeCamera& head, const Vector3<double>& view);

//! Returns the affine distance [M] from a head to the first of some meshes that it sees in a
//! direction of its view; infinite if it sees none. Uses double rays.
double distance_of_objects(const PlacedMeshes& meshes, const EyeCamera& head, const Vector3<double>& view);

//! Returns the affine distance [M] from a head to a point that it sees in a direction of its view;
//! nothing if light from that direction does not pass the point.
std::optional<double> distance_of_place(const EyeCamera& head, const Vector3<double>& view,
                                        const Vector3<double>& place);

}  // namespace ergodome
