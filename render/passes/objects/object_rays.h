#pragma once

#include <optional>
#include <vector>

#include "content/mesh/triangle_boxes.h"
#include "content/show/show.h"
#include "kernels/objects/mesh_rays.h"
#include "render/passes/objects/placed_meshes.h"

namespace ergodome {

//! A show's objects at an instant, for intersection with exact rays around a hole of any spin.
//! Reference for the accuracy of drawn objects.
class ObjectRays {
 public:
  //! Reads or generates the meshes and builds their trees. Throws Error if a mesh cannot be read.
  ObjectRays(const Show& show, double time_s);

  //! Returns the first hit of an object on the ray that a camera sees in direction `n`, a unit
  //! vector in (e_r, e_θ, e_φ); MeshHit::mesh is -1 if the ray hits none. `tolerance`: local error
  //! of the path. Returns nothing if the ray does not converge.
  [[nodiscard]] std::optional<MeshHit> first_hit(const CameraStation& camera, const Vector3<double>& n,
                                                 double tolerance = 1e-12) const;

  //! Returns the index of the mesh triangle that was hit.
  [[nodiscard]] std::uint32_t triangle(const MeshHit& hit) const;

 private:
  std::vector<TriangleBoxes> boxes_;
  PlacedMeshes placed_;
};

}  // namespace ergodome
