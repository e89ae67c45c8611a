#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>

#include "kernels/core/vector3.h"

// A tree of boxes about a mesh's triangles, to find those near a segment.
namespace ergodome {

//! A bounding box of triangles.
struct TreeNode {
  float low[3];
  std::uint32_t first;  //!< leaf: its first triangle; otherwise the first of two adjacent children
  float high[3];
  std::uint32_t count;  //!< number of triangles of a leaf; 0: not a leaf
};

//! A mesh for rays, in its own unit: a tree of boxes, the root first. An empty mesh has no nodes.
struct TriangleTree {
  const TreeNode* nodes;
  const float* corners;            //!< corners' coordinates, nine per triangle, in order of leaves
  const std::uint32_t* triangles;  //!< index in the mesh of each triangle of `corners`
  Vector3<double> middle;          //!< center of a sphere that contains all
  double radius;                   //!< radius of that sphere
};

//! Maximum depth of a tree.
inline constexpr int deepest_tree = 64;

//! A triangle's corner and the sides from it.
struct TriangleSides {
  Vector3<double> corner;
  Vector3<double> side_1;
  Vector3<double> side_2;
};

inline namespace ERGO_TARGET {

ERGO_HD TriangleSides triangle_sides(const TriangleTree& tree, std::uint32_t position) {
  const float* const c = tree.corners + 9 * static_cast<std::size_t>(position);
  const auto corner = [c](int i) {
    return Vector3<double>{static_cast<double>(c[3 * i]), static_cast<double>(c[3 * i + 1]),
                           static_cast<double>(c[3 * i + 2])};
  };
  return {corner(0), corner(1) - corner(0), corner(2) - corner(0)};
}

namespace detail {

//! Returns whether a segment comes within `margin` of a box; sometimes also for segments that pass
//! a corner slightly farther away. `per_way`: inverse of each component of the vector from its
//! beginning to its end.
ERGO_HD bool comes_near(const TreeNode& node, const double (&from)[3], const double (&per_way)[3], double margin) {
  double enter = 0.0;
  double leave = 1.0;
  for (int axis = 0; axis < 3; ++axis) {
    const double low = static_cast<double>(node.low[axis]) - margin - from[axis];
    const double high = static_cast<double>(node.high[axis]) + margin - from[axis];
    const double first = low * per_way[axis];
    const double second = high * per_way[axis];
    enter = ::fmax(enter, ::fmin(first, second));
    leave = ::fmin(leave, ::fmax(first, second));
  }
  return enter <= leave;
}

}  // namespace detail

//! Calls visit(index) with the index in the tree of each triangle that a segment may come within
//! `margin` of, and possibly of some more.
template <class Visit>
ERGO_HD void visit_triangles(const TriangleTree& tree, const Vector3<double>& from, const Vector3<double>& to,
                             double margin, Visit&& visit) {
  const double start[3] = {from.x, from.y, from.z};
  // A component of zero becomes a very small one, so that multiples of its inverse stay finite.
  const auto one_over = [](double way) { return 1.0 / (::fabs(way) > 1e-200 ? way : 1e-200); };
  const double per_way[3] = {one_over(to.x - from.x), one_over(to.y - from.y), one_over(to.z - from.z)};
  std::uint32_t waiting[deepest_tree + 1];
  int count = 0;
  waiting[count++] = 0;
  while (count > 0) {
    const TreeNode& node = tree.nodes[waiting[--count]];
    if (!detail::comes_near(node, start, per_way, margin)) {
      continue;
    }
    if (node.count > 0) {
      for (std::uint32_t i = 0; i < node.count; ++i) {
        visit(node.first + i);
      }
    } else if (count + 2 <= deepest_tree + 1) {
      waiting[count++] = node.first;
      waiting[count++] = node.first + 1;
    }
  }
}

}  // namespace ERGO_TARGET
}  // namespace ergodome
