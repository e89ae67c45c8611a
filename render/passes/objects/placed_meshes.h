#pragma once

#include <span>
#include <vector>

#include "content/objects/object_motion.h"
#include "kernels/objects/placed_mesh.h"

namespace ergodome {

//! Meshes where a show's objects have them at an instant.
struct PlacedMeshes {
  std::vector<PlacedMesh> meshes;  //!< one an object
  double least_r = 0.0;            //!< of the balls about the objects; 0 where one holds the hole [M]
  double greatest_r = 0.0;

  //! As rays about a hole of some spin look for them, with the meshes at some place: what is next to the horizon is not looked for.
  [[nodiscard]] MeshScene around(double spin, const PlacedMesh* at) const;
};

//! Puts a tree an object where the object is at a show time. There must be objects.
PlacedMeshes place_meshes(const std::vector<ObjectSettings>& objects, std::span<const TriangleTree> trees,
                          double time_s);

}  // namespace ergodome
