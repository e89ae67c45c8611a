#include "content/mesh/formats/polygon_triangles.h"

#include <gtest/gtest.h>

#include <cmath>

namespace ergodome {
namespace {

using Corners = std::vector<Vector3<double>>;

double area_of(const Corners& corners, const std::vector<std::array<std::uint32_t, 3>>& triangles) {
  double area = 0.0;
  for (const auto& [a, b, c] : triangles) {
    area += 0.5 * cross(corners[b] - corners[a], corners[c] - corners[a]).z;
  }
  return area;
}

TEST(PolygonTriangles, OfAConvexFaceCoverIt) {
  Corners circle;
  constexpr int sides = 100;
  for (int i = 0; i < sides; ++i) {
    circle.push_back({std::cos(2.0 * M_PI * i / sides), std::sin(2.0 * M_PI * i / sides), 0.0});
  }
  const auto triangles = triangles_of_polygon(circle);
  EXPECT_EQ(triangles.size(), sides - 2U);
  EXPECT_NEAR(area_of(circle, triangles), 0.5 * sides * std::sin(2.0 * M_PI / sides), 1e-12);
}

TEST(PolygonTriangles, OfConcaveFacesLieWithinThem) {
  // Polygons that are not convex: an arrow, an L and a comb. Triangles that all start at the first
  // corner would extend outside them.
  const Corners arrow = {{0, 0, 0}, {2, 1, 0}, {0, 2, 0}, {1, 1, 0}};
  const Corners bent = {{0, 0, 0}, {3, 0, 0}, {3, 1, 0}, {1, 1, 0}, {1, 3, 0}, {0, 3, 0}};
  const Corners comb = {{0, 3, 0}, {0, 0, 0}, {5, 0, 0}, {5, 3, 0}, {4, 3, 0}, {4, 1, 0},
                        {3, 1, 0}, {3, 3, 0}, {2, 3, 0}, {2, 1, 0}, {1, 1, 0}, {1, 3, 0}};
  for (const auto& [corners, area] : {std::pair(arrow, 1.0), std::pair(bent, 5.0), std::pair(comb, 11.0)}) {
    const auto triangles = triangles_of_polygon(corners);
    EXPECT_EQ(triangles.size(), corners.size() - 2);
    double sum = 0.0;
    for (const auto& triangle : triangles) {
      const double own = area_of(corners, {triangle});
      EXPECT_GE(own, 0.0) << "wound as the face is";
      sum += own;
    }
    EXPECT_NEAR(sum, area, 1e-12);
  }
}

TEST(PolygonTriangles, AreWoundAsTheFaceIsInAnyPlane) {
  const Corners flat = {{0, 0, 0}, {3, 0, 0}, {3, 1, 0}, {1, 1, 0}, {1, 3, 0}, {0, 3, 0}};
  for (int plane = 0; plane < 6; ++plane) {
    Corners turned;
    for (const Vector3<double>& p : flat) {
      const double y = plane < 3 ? p.y : -p.y;
      turned.push_back(plane % 3 == 0   ? Vector3<double>{p.x, y, 0.0}
                       : plane % 3 == 1 ? Vector3<double>{0.0, p.x, y}
                                        : Vector3<double>{y, 0.0, p.x});
    }
    Vector3<double> normal = {0.0, 0.0, 0.0};
    for (const auto& [a, b, c] : triangles_of_polygon(turned)) {
      normal = normal + 0.5 * cross(turned[b] - turned[a], turned[c] - turned[a]);
    }
    const Vector3<double> out = cross(turned[1] - turned[0], turned[2] - turned[0]);
    EXPECT_NEAR(dot(normal, out) / std::sqrt(dot(out, out)), 5.0, 1e-12) << plane;
  }
}

TEST(PolygonTriangles, OfAQuadHaveTheShorterDiagonal) {
  const Corners kite = {{0, 0, 0}, {5, -1, 0}, {10, 0, 0}, {5, 1, 0}};
  EXPECT_EQ(triangles_of_polygon(kite), (std::vector<std::array<std::uint32_t, 3>>{{0, 1, 3}, {1, 2, 3}}));
}

TEST(PolygonTriangles, AreThereForFacesThatCrossThemselvesOrHaveNoArea) {
  const Corners bow = {{0, 0, 0}, {1, 1, 0}, {1, 0, 0}, {0, 1, 0}};
  const Corners line = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {3, 0, 0}, {4, 0, 0}};
  EXPECT_EQ(triangles_of_polygon(bow).size(), 2U);
  EXPECT_EQ(triangles_of_polygon(line).size(), 3U);
}

}  // namespace
}  // namespace ergodome
