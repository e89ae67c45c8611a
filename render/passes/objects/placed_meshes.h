#pragma once

#include <span>
#include <vector>

#include "content/objects/object_motion.h"
#include "kernels/objects/placed_mesh.h"
#include "kernels/spacetime/spacetime.h"

namespace ergodome {

//! The meshes of a show's objects, placed at an instant.
struct PlacedMeshes {
  std::vector<PlacedMesh> meshes;  //!< one per object
  //! Distance [M] from the center of the hole to the nearest point of all bounding spheres
  //! (`min_r`; 0 if one contains the center), and to the farthest (`max_r`).
  double min_r = 0.0;
  double max_r = 0.0;

  //! Returns the meshes as a scene for rays around a hole with a spin. `at`: address at which
  //! kernels read the meshes. Parts of objects next to the horizon are ignored.
  [[nodiscard]] MeshScene around(Spacetime spacetime, const PlacedMesh* at) const;
};

//! Places objects at a show time; `trees` has one tree per object. There must be objects.
PlacedMeshes place_meshes(const std::vector<ObjectSettings>& objects, std::span<const TriangleTree> trees,
                          double time_s);

}  // namespace ergodome
