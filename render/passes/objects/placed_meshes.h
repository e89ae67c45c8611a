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
  double least_r = 0.0;            //!< of the bounding spheres; 0 if one contains the center of the hole [M]
  double greatest_r = 0.0;

  //! Returns the scene for rays around a hole with a spin. `at`: address of the meshes for the
  //! kernels. Parts of objects next to the horizon are ignored.
  [[nodiscard]] MeshScene around(Spacetime spacetime, const PlacedMesh* at) const;
};

//! Places one tree per object at a show time. There must be objects.
PlacedMeshes place_meshes(const std::vector<ObjectSettings>& objects, std::span<const TriangleTree> trees,
                          double time_s);

}  // namespace ergodome
