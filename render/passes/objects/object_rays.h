#pragma once

#include <optional>
#include <vector>

#include "content/mesh/triangle_boxes.h"
#include "content/show/show.h"
#include "kernels/objects/mesh_rays.h"
#include "render/passes/objects/placed_meshes.h"

namespace ergodome {

//! A show's objects at an instant, as exact rays meet them, about a hole of any spin: what drawing them is measured by.
class ObjectRays {
 public:
  //! Reads or makes the meshes, and puts trees over them. Throws Error where a mesh cannot be read.
  ObjectRays(const Show& show, double time_s);

  //! The first object on the ray that a camera sees in direction `n`, unit vector in (e_r, e_θ, e_φ); none: `mesh` is -1. `tolerance` is the local error
  //! of the path. Nothing where the ray does not converge.
  [[nodiscard]] std::optional<MeshHit> look(const CameraStation& camera, const Vector3<double>& n,
                                            double tolerance = 1e-12) const;

  //! Which of its mesh's triangles a hit is on.
  [[nodiscard]] std::uint32_t triangle(const MeshHit& hit) const;

 private:
  std::vector<TriangleBoxes> boxes_;
  PlacedMeshes placed_;
};

}  // namespace ergodome
