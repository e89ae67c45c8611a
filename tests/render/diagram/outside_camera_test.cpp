#include "render/diagram/outside_camera.h"

#include <gtest/gtest.h>

#include <cmath>

#include "kernels/core/angles.h"
#include "render/diagram/spread_choice.h"
#include "tests/render/diagram/point.h"

namespace ergodome {
namespace {

using test::length_of;
using test::Point;

const std::vector<Point> some_positions = {{40.0, 0.0, 0.0}, {-30.0, 5.0, 2.0}, {0.0, -3.0, 12.0}, {0.0, 9.0, -8.0}};

TEST(OutsideCameras, HaveAllPlacesInTheirBandOfThePicture) {
  for (const double elevation : {-80.0, 0.0, 24.0, 90.0}) {
    const OutsideCamera camera =
        outside_camera({70.0 * one_degree, elevation * one_degree, std::nullopt}, some_positions, 1.6, {0.2, 1.0});
    double widest = 0.0;
    for (const Point& position : some_positions) {
      const Point at = camera.in_view(position);
      const double x = at.x / (-at.z * camera.half_width);
      const double y = at.y / (-at.z * camera.half_height);
      EXPECT_LT(std::abs(x), 1.0) << elevation;
      EXPECT_LT(y, 1.0) << elevation;
      EXPECT_GT(y, -0.6) << elevation;
      EXPECT_GT(-at.z, camera.nearest);
      EXPECT_LT(-at.z, camera.farthest);
      widest = std::max({widest, std::abs(x), (std::abs(y - 0.2)) / 0.8});
    }
    // Horizontally or vertically, the points reach the margin of the part of the picture that is
    // available for them.
    EXPECT_GT(widest, 0.9) << elevation;
  }
}

TEST(OutsideCameras, StandWhereTheyAreTold) {
  // The center of these points is the origin.
  const std::vector<Point> cross = {{5.0, 0.0, 0.0}, {-5.0, 0.0, 0.0}, {0.0, 5.0, 0.0}, {0.0, -5.0, 0.0}};
  const OutsideCamera camera = outside_camera({0.0, 0.5 * pi, 100.0}, cross, 1.0, {0.0, 1.0});
  EXPECT_LT(length_of(camera.position - Point{0.0, 0.0, 100.0}), 1e-9);
  EXPECT_LT(length_of(camera.up - Point{-1.0, 0.0, 0.0}), 1e-12);
}

TEST(OutsideCameras, SeeASphereInItsOutline) {
  const OutsideCamera camera = outside_camera({0.3, 0.4, std::nullopt}, some_positions, 1.6, {0.0, 1.0});
  for (const Point& position : sphere_outline(3.0, camera)) {
    EXPECT_NEAR(length_of(position), 3.0, 1e-12);
    // At each point of the outline, the line of sight is tangent to the sphere.
    EXPECT_NEAR(dot(position, camera.position - position), 0.0, 1e-9);
  }
}

TEST(SpreadChoice, TakesPlacesThatAreFarFromEachOther) {
  std::vector<Point> row;
  for (int i = 0; i <= 8; ++i) {
    row.push_back({static_cast<double>(i), 0.0, 0.0});
  }
  EXPECT_EQ(spread_choice(row, 3), (std::vector<std::size_t>{0, 8, 4}));
}

TEST(SpreadChoice, TakesNoPlaceTwice) {
  const std::vector<Point> positions = {{0.0, 0.0, 0.0}, {1.0, 0.0, 0.0}, {0.0, 0.0, 0.0}, {1.0, 0.0, 0.0}};
  EXPECT_EQ(spread_choice(positions, 4).size(), 2U);
}

}  // namespace
}  // namespace ergodome
