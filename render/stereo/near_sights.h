#pragma once

#include <optional>
#include <vector>

#include "content/show/show.h"
#include "render/eyes/eye_camera.h"
#include "render/passes/objects/placed_meshes.h"

// Finds the points of disk, shells and objects that a head sees in a direction.

namespace ergodome {

//! A point that a head sees in some direction: one that the light passes on its way to the head.
struct NearSight {
  Vector3<double> position;  //!< position of the point, pseudo-Cartesian [M]
  double distance;           //!< affine distance from the head [M]
  bool first;                //!< true at the path's first crossing of the shell or disk's plane
  bool opaque;               //!< true if the opacity of the disk, or of the shell's filling, exceeds 0.9
};

//! Returns the points of a show's disk and shells that a head sees in a direction of its view,
//! nearest first, up to the first opaque one. Traces rays in double precision.
std::vector<NearSight> near_sights(const Show& show, const EyeCamera& head, const Vector3<double>& view);

//! Returns the affine distance [M] from a head to the nearest point of some meshes in a direction
//! of its view; infinite if it sees none. Traces rays in double precision.
double distance_of_objects(const PlacedMeshes& meshes, const EyeCamera& head, const Vector3<double>& view);

//! Returns the affine distance [M] from a head to a point that it sees in a direction of its view.
//! Returns nothing if light from that direction does not pass the point within 0.001 of its radius.
std::optional<double> distance_of_position(const EyeCamera& head, const Vector3<double>& view,
                                           const Vector3<double>& position);

}  // namespace ergodome
