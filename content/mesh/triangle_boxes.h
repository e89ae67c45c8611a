#pragma once

#include <vector>

#include "content/mesh/triangle_mesh.h"
#include "kernels/objects/triangle_tree.h"

namespace ergodome {

//! A bounding volume hierarchy over a mesh's triangles that owns its memory; view() is what kernels
//! use.
struct TriangleBoxes {
  std::vector<TreeNode> nodes;
  //! Coordinates of the three corners of each triangle, in the order of the leaves.
  std::vector<float> corners;
  //! Index in the mesh of each triangle, in the same order as `corners`.
  std::vector<std::uint32_t> triangles;
  Vector3<double> middle{};  //!< center of the box around all triangles
  //! Radius of the sphere around `middle` that contains all triangles.
  double radius = 0.0;

  [[nodiscard]] TriangleTree view() const { return {nodes.data(), corners.data(), triangles.data(), middle, radius}; }
  [[nodiscard]] long bytes() const {
    return static_cast<long>(nodes.size() * sizeof(TreeNode) + corners.size() * sizeof(float) +
                             triangles.size() * sizeof(std::uint32_t));
  }
};

//! Builds the hierarchy top down with the surface area heuristic: each cut minimizes the sum of
//! area times triangle count over both parts (Wald 2007, with sixteen bins per axis). The mesh must
//! have at least 1 and fewer than 2^31 triangles.
TriangleBoxes build_triangle_tree(const TriangleMesh& mesh);

}  // namespace ergodome
