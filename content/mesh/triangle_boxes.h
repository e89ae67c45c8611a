#pragma once

#include <vector>

#include "content/mesh/triangle_mesh.h"
#include "kernels/objects/triangle_tree.h"

namespace ergodome {

//! A tree of boxes over a mesh's triangles, in memory of its own.
struct TriangleBoxes {
  std::vector<TreeNode> nodes;
  std::vector<float> corners;            //!< nine numbers a triangle, in the order of the leaves
  std::vector<std::uint32_t> triangles;  //!< which of the mesh's triangles each of them is
  Vector3<double> middle{};              //!< of the box about all
  double radius = 0.0;                   //!< of the sphere about that which holds all

  [[nodiscard]] TriangleTree view() const { return {nodes.data(), corners.data(), triangles.data(), middle, radius}; }
  [[nodiscard]] long bytes() const {
    return static_cast<long>(nodes.size() * sizeof(TreeNode) + corners.size() * sizeof(float) +
                             triangles.size() * sizeof(std::uint32_t));
  }
};

//! Builds it top down; boxes are cut where the areas of both parts, times their triangles, are least (Wald 2007, with sixteen bins an axis).
//! The mesh must have triangles, and no more than 2^31.
TriangleBoxes build_triangle_tree(const TriangleMesh& mesh);

}  // namespace ergodome
