#include "render/diagram/apparent_mesh.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "content/mesh/built_in_meshes.h"
#include "kernels/core/angles.h"
#include "kernels/spacetime/schwarzschild/apparent_position.h"
#include "tests/render/diagram/point.h"

// Tests of meshes at the positions where an observer sees them.
namespace ergodome {
namespace {

using test::length_of;
using test::Point;

constexpr Point far_observer = {40.0, 0.0, 0.0};
const ApparentSettings fine_settings{0.02, 6, 10.0};

ObjectPlacement standing_at(const Point& position) {
  return {position, {{1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}, {0.0, 0.0, 1.0}}};
}

TriangleMesh leaning_triangle() { return make_triangle({{{{0.0, 0.0, 0.0}, {0.0, 2.5, 0.0}, {0.0, 0.0, 2.5}}}}); }

TEST(ApparentMesh, CornersLieWhereLightComesFromAsFarAsItHasTakenTime) {
  for (const int order : {1, 2, 3}) {
    const ApparentMesh mesh =
        apparent_mesh(far_observer, leaning_triangle(), standing_at({-5.0, 2.0, -0.5}), 1.0, order, fine_settings);
    ASSERT_FALSE(mesh.triangles.empty());
    for (const ApparentVertex& vertex : mesh.vertices) {
      const ApparentPosition position = apparent_position(far_observer, vertex.position, order);
      EXPECT_LT(length_of(vertex.seen - far_observer - position.travel_time * position.direction), 1e-12);
    }
  }
}

TEST(ApparentMesh, FarFromTheHoleItIsTheMeshItself) {
  // Apparent positions are measured by the travel time of light. Far from the hole, this makes
  // lengths larger: by a relative 1/r across the radius, by 2/r along it.
  for (const double far : {1e3, 1e4, 1e5}) {
    const Point observer = {far, 0.0, 0.0};
    const ApparentMesh mesh =
        apparent_mesh(observer, make_sphere({12, 6}), standing_at({far, 20.0, 0.0}), 1.0, 1, fine_settings);
    for (const ApparentVertex& vertex : mesh.vertices) {
      EXPECT_LT(length_of(vertex.seen - vertex.position), 2.0 / far * length_of(vertex.position - observer));
    }
  }
}

TEST(ApparentMesh, WhereItIsBentEdgesAreDividedUntilTheyAreStraight) {
  const ApparentSettings settings{0.02, 12, 10.0};
  const ApparentMesh mesh =
      apparent_mesh(far_observer, leaning_triangle(), standing_at({-5.0, 2.0, -0.5}), 1.0, 1, settings);
  EXPECT_GT(mesh.triangles.size(), 20U);
  for (const auto& t : mesh.triangles) {
    for (std::size_t i = 0; i < 3; ++i) {
      const ApparentVertex& a = mesh.vertices[t[i]];
      const ApparentVertex& b = mesh.vertices[t[(i + 1) % 3]];
      const Point middle = apparent_vertex(far_observer, 0.5 * (a.position + b.position), 1).seen;
      EXPECT_LE(length_of(middle - 0.5 * (a.seen + b.seen)), settings.tolerance);
    }
  }
}

TEST(ApparentMesh, DividedTrianglesLeaveNoGap) {
  // In a closed surface, each edge belongs to two triangles. The sphere has several vertices at the
  // same position (at its seam and poles), so vertices are identified by position.
  const ApparentMesh mesh =
      apparent_mesh(far_observer, make_sphere({12, 6}), standing_at({-6.0, 5.0, 0.0}), 1.0, 1, fine_settings);
  const auto key = [&](std::uint32_t i) {
    const Point& p = mesh.vertices[i].position;
    return std::array<long, 3>{std::lround(p.x * 1e5), std::lround(p.y * 1e5), std::lround(p.z * 1e5)};
  };
  std::map<std::array<std::array<long, 3>, 2>, int> edges;
  for (const auto& t : mesh.triangles) {
    for (std::size_t i = 0; i < 3; ++i) {
      std::array<std::array<long, 3>, 2> edge = {key(t[i]), key(t[(i + 1) % 3])};
      std::ranges::sort(edge);
      ++edges[edge];
    }
  }
  EXPECT_GT(mesh.triangles.size(), 120U);
  EXPECT_TRUE(std::ranges::all_of(edges, [](const auto& edge) { return edge.second == 2; }));
}

TEST(ApparentMesh, TheTriangleBehindTheHoleIsLeftOut) {
  // The triangle intersects the line from the observer through the hole. The image of the
  // intersection is a ring.
  const TriangleMesh mesh = make_triangle({{{{0.0, -1.0, -1.0}, {0.0, 1.5, -1.0}, {0.0, 0.0, 1.5}}}});
  const ApparentMesh seen = apparent_mesh(far_observer, mesh, standing_at({-8.0, 0.0, 0.0}), 1.0, 1, fine_settings);
  ASSERT_FALSE(seen.triangles.empty());
  for (const auto& t : seen.triangles) {
    // No triangle may extend over the ring: its corners must be on the same side of the hole.
    double widest = 1.0;
    for (std::size_t i = 0; i < 3; ++i) {
      const Point& one = seen.vertices[t[i]].direction;
      const Point& other = seen.vertices[t[(i + 1) % 3]].direction;
      widest = std::min(
          widest, (one.y * other.y + one.z * other.z) / (std::hypot(one.y, one.z) * std::hypot(other.y, other.z)));
    }
    EXPECT_GT(widest, 0.0);
  }
}

TEST(ApparentMesh, WhatReachesIntoTheHoleIsLeftOut) {
  const ApparentMesh mesh =
      apparent_mesh(far_observer, make_sphere({24, 12}), standing_at({2.0, 0.0, 0.0}), 1.0, 1, fine_settings);
  ASSERT_FALSE(mesh.triangles.empty());
  for (const auto& t : mesh.triangles) {
    for (const std::uint32_t i : t) {
      EXPECT_TRUE(mesh.vertices[i].connected);
      EXPECT_GT(length_of(mesh.vertices[i].position), 2.0);
    }
  }
}

}  // namespace
}  // namespace ergodome
