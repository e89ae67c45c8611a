#include "content/mesh/built_in_meshes.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <vector>

#include "content/mesh/triangle_boxes.h"
#include "kernels/core/angles.h"
#include "tests/support/errors.h"
#include "tests/support/sanitized.h"

namespace ergodome {
namespace {

using test::error_of;

Vector3<double> position(const TriangleMesh& mesh, std::size_t index) {
  const float(&p)[3] = mesh.vertices[mesh.indices[index]].position;
  return {p[0], p[1], p[2]};
}

//! Returns six times the volume that the triangles enclose. It is positive if they are
//! counterclockwise as seen from outside.
double signed_volume(const TriangleMesh& mesh) {
  double sum = 0.0;
  for (std::size_t i = 0; i < mesh.indices.size(); i += 3) {
    sum += dot(position(mesh, i), cross(position(mesh, i + 1), position(mesh, i + 2)));
  }
  return sum / 6.0;
}

//! Returns whether the surface is closed: whether its triangles traverse each edge equally often in
//! both directions.
bool is_closed(const TriangleMesh& mesh) {
  const auto key = [](const Vector3<double>& v) {
    return std::array{std::lround(v.x * 1e4), std::lround(v.y * 1e4), std::lround(v.z * 1e4)};
  };
  std::map<std::pair<std::array<long, 3>, std::array<long, 3>>, int> edges;
  for (std::size_t i = 0; i < mesh.indices.size(); ++i) {
    const std::size_t next = i % 3 == 2 ? i - 2 : i + 1;
    const auto from = key(position(mesh, i));
    const auto to = key(position(mesh, next));
    ++edges[{from, to}];
    --edges[{to, from}];
  }
  return std::ranges::all_of(edges, [](const auto& edge) { return edge.second == 0; });
}

TEST(BuiltInMeshes, TheSphereOfMuellerSchulzAndWeiskopfHas1224TrianglesAndEnclosesABall) {
  const TriangleMesh mesh = make_sphere({});
  EXPECT_EQ(mesh.triangle_count(), 1224);
  EXPECT_EQ(mesh.dropped_triangles, 0);
  EXPECT_TRUE(is_closed(mesh));
  EXPECT_EQ(mesh.parts.front().index_count, mesh.indices.size());
  EXPECT_NEAR(signed_volume(make_sphere({256, 128})), 4.0 / 3.0 * pi, 2e-3);
  EXPECT_NEAR(radius_of(mesh), 1.0, 1e-6);
}

TEST(BuiltInMeshes, TheThickDiskHas2560TrianglesInThreeColoursAndEnclosesItsVolume) {
  const DiskShape shape;
  const TriangleMesh mesh = make_disk(shape);
  EXPECT_EQ(mesh.triangle_count(), 2560);
  EXPECT_TRUE(is_closed(mesh));
  ASSERT_EQ(mesh.parts.size(), 3U);
  EXPECT_EQ(std::set({mesh.parts[0].color, mesh.parts[1].color, mesh.parts[2].color}).size(), 3U);
  // The disk is a prism with 64 sides and a hole; this is its volume.
  const double ring = 0.5 * shape.segments * std::sin(2.0 * pi / shape.segments);
  const double volume = ring * (shape.outer * shape.outer - shape.inner * shape.inner) * shape.thickness;
  EXPECT_NEAR(signed_volume(mesh), volume, 1e-4 * volume);
}

TEST(BuiltInMeshes, NormalsPointTheWayThatTrianglesFace) {
  for (const TriangleMesh& mesh : {make_sphere({}), make_disk({}), make_triangle({})}) {
    for (std::size_t i = 0; i < mesh.indices.size(); i += 3) {
      const Vector3<double> face =
          cross(position(mesh, i + 1) - position(mesh, i), position(mesh, i + 2) - position(mesh, i));
      const float(&n)[3] = mesh.vertices[mesh.indices[i]].normal;
      const Vector3<double> normal{n[0], n[1], n[2]};
      ASSERT_NEAR(dot(normal, normal), 1.0, 1e-6);
      ASSERT_GT(dot(face, normal), 0.9 * std::sqrt(dot(face, face)));
    }
  }
}

TEST(BuiltInMeshes, RefuseATriangleOnALine) {
  const TriangleShape line{{{{0.0, 0.0, 0.0}, {1.0, 1.0, 1.0}, {3.0, 3.0, 3.0}}}};
  EXPECT_THAT(error_of([&] { make_triangle(line); }), testing::HasSubstr("on one line"));
}

TEST(BuiltInMeshes, HoldTenMillionTriangles) {
  const TriangleMesh mesh = make_sphere({3163, 1582});
  EXPECT_GT(mesh.triangle_count(), 10'000'000);
  EXPECT_EQ(mesh.parts.front().index_count, mesh.indices.size());
}

//! Checks a bounding-volume tree from the node `at` on. Returns whether each box contains
//! everything below it. Counts in `met` how often each triangle is in a leaf.
bool boxes_hold(const TriangleBoxes& tree, std::size_t at, int depth, std::vector<int>& met) {
  const TreeNode& node = tree.nodes[at];
  bool holds = depth <= deepest_tree;
  for (std::uint32_t i = 0; i < node.count; ++i) {
    const std::size_t position = node.first + i;
    ++met[tree.triangles[position]];
    for (std::size_t corner = 0; corner < 9; ++corner) {
      const float value = tree.corners[9 * position + corner];
      holds = holds && value >= node.low[corner % 3] && value <= node.high[corner % 3];
    }
  }
  for (std::size_t child = 0; child < 2 && node.count == 0; ++child) {
    const TreeNode& below = tree.nodes[node.first + child];
    for (std::size_t axis = 0; axis < 3; ++axis) {
      holds = holds && below.low[axis] >= node.low[axis] && below.high[axis] <= node.high[axis];
    }
    holds = boxes_hold(tree, node.first + child, depth + 1, met) && holds;
  }
  return holds;
}

TEST(TriangleTrees, OfFewAndOfManyTrianglesHoldEachOfThemOnce) {
  // Trees of many triangles are built in parts, by several threads.
  for (const SphereShape& shape :
       {SphereShape{12, 6}, SphereShape{90, 45}, test::sanitized ? SphereShape{200, 100} : SphereShape{900, 450}}) {
    const TriangleMesh mesh = make_sphere(shape);
    const TriangleBoxes tree = build_triangle_tree(mesh);
    std::vector<int> met(static_cast<std::size_t>(mesh.triangle_count()), 0);
    EXPECT_TRUE(boxes_hold(tree, 0, 0, met)) << shape.segments;
    EXPECT_TRUE(std::ranges::all_of(met, [](int times) { return times == 1; })) << shape.segments;
    EXPECT_EQ(tree.corners.size(), 9 * met.size());
    EXPECT_NEAR(tree.radius, 1.0, 1e-6);
    // Only nodes with more than four triangles are split in two, so leaves contain at least two
    // triangles, and there are fewer nodes than triangles.
    EXPECT_LT(tree.nodes.size(), 1 + met.size());
  }
}

}  // namespace
}  // namespace ergodome
