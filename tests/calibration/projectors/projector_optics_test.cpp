#include "calibration/projectors/projector_optics.h"

#include <gtest/gtest.h>

#include <cmath>

#include "kernels/core/angles.h"
#include "kernels/core/error.h"

namespace ergodome {
namespace {

DomeSetup dome(double radius_m) {
  DomeSetup setup;
  setup.radius_m = radius_m;
  return setup;
}

ProjectorSetup projector_with(const Lens& lens, const Vector3<double>& position_m, const Orientation& orientation) {
  ProjectorSetup projector;
  projector.name = "test";
  projector.lens = lens;
  projector.position_m = position_m;
  projector.orientation = orientation;
  projector.width_px = 1920;
  projector.height_px = 1200;
  return projector;
}

ProjectorSetup mirrored(const ProjectorSetup& projector, const Vector3<double>& position_m, double radius_m) {
  ProjectorSetup with = projector;
  with.mirror = SphericalMirror{position_m, radius_m};
  return with;
}

ProjectorSetup flat() { return projector_with(Frustum{-35, 25, 20, -28}, {0.5, -1.0, 6.0}, {170, 35, 12}); }

ProjectorSetup fisheye() {
  ProjectorFisheye lens;
  lens.field_of_view_deg = 165.0;
  lens.circle = 1.1;
  lens.offset_x = 0.05;
  lens.offset_y = -0.1;
  return projector_with(lens, {0.3, 0.2, 1.0}, {30, 80, 0});
}

ProjectorSetup polynomial() {
  ProjectorFisheye lens;
  lens.field_of_view_deg = 150.0;
  lens.polynomial = {0.55, -0.02, 0.001};
  return projector_with(lens, {0.0, 0.1, 0.0}, {0, 90, 0});
}

TEST(ProjectorOptics, AFlatLensLooksAlongItsAxisToTheSphere) {
  const ProjectorOptics optics(dome(5.0), projector_with(Frustum{-30, 30, 20, -20}, {0, 0, 2}, {0, 0, 0}));
  const auto point = optics.dome_point({0.5, 0.5});
  ASSERT_TRUE(point);
  EXPECT_NEAR(point->x, 0.0, 1e-12);
  EXPECT_NEAR(point->y, 0.0, 1e-12);
  EXPECT_NEAR(point->z, -5.0, 1e-12);
}

TEST(ProjectorOptics, TheRightSideOfTheRasterIsToTheRight) {
  const ProjectorOptics optics(dome(5.0), projector_with(Frustum{-30, 30, 20, -20}, {0, 0, 0}, {0, 0, 0}));
  const auto right = optics.dome_point({1.0, 0.5});
  const auto top = optics.dome_point({0.5, 0.0});
  ASSERT_TRUE(right && top);
  EXPECT_NEAR(right->x, 5.0 * std::sin(pi / 6.0), 1e-12);
  EXPECT_NEAR(top->y, 5.0 * std::sin(pi / 9.0), 1e-12);
}

TEST(ProjectorOptics, AFisheyesRimIsHalfItsFieldFromTheAxis) {
  ProjectorFisheye lens;
  lens.field_of_view_deg = 140.0;
  lens.circle = 1.2;
  const ProjectorOptics optics(dome(5.0), projector_with(lens, {0, 0, 0}, {0, 90, 0}));
  const auto rim = optics.dome_point({0.5, 0.5 + 0.5 * 1.2});
  ASSERT_TRUE(rim);
  EXPECT_NEAR(std::acos(rim->y / 5.0), 70.0 * pi / 180.0, 1e-12);
}

//! A mirror ball below the projector deflects its vertical light by twice the slope of the mirror
//! at the point of incidence.
TEST(ProjectorOptics, AMirrorTurnsLightByTwiceItsSlope) {
  constexpr double radius = 0.4;
  constexpr double high = 1e3;
  const ProjectorSetup above = projector_with(Frustum{-1, 1, 1, -1}, {0, high, 0}, {0, -90, 0});
  const ProjectorOptics optics(dome(1e6), mirrored(above, {0, 0, 0}, radius));
  for (const double slope : {0.05, 0.3, 0.7}) {
    const double angle = std::atan(radius * std::sin(slope) / (high - radius * std::cos(slope)));
    const double x = 0.5 + 0.5 * std::tan(angle) / std::tan(pi / 180.0);
    const auto point = optics.dome_point({x, 0.5});
    ASSERT_TRUE(point);
    EXPECT_NEAR(std::atan2(std::hypot(point->x, point->z), point->y), 2.0 * slope + angle, 1e-6);
  }
}

TEST(ProjectorOptics, LightThatMissesTheMirrorGoesNowhere) {
  const ProjectorSetup below = projector_with(Frustum{-20, 20, 20, -20}, {0, 0, 2}, {0, 0, 0});
  const ProjectorOptics optics(dome(5.0), mirrored(below, {0, 0, 0}, 0.3));
  EXPECT_TRUE(optics.dome_point({0.5, 0.5}));
  EXPECT_FALSE(optics.dome_point({0.02, 0.5}));
}

class OpticsOf : public testing::TestWithParam<ProjectorSetup> {};

TEST_P(OpticsOf, PlacesComeBackFromTheDome) {
  const ProjectorOptics optics(dome(7.0), GetParam());
  int positions = 0;
  for (int i = 1; i < 400; ++i) {
    const int row = i / 20;
    const RasterPosition position = {(i - 20 * row) / 20.0, row / 20.0};
    const auto point = optics.dome_point(position);
    if (!point || !(optics.depth(position) > 0.0)) {
      continue;
    }
    EXPECT_NEAR(std::sqrt(dot(*point, *point)), 7.0, 1e-9);
    const auto back = optics.raster_position(*point);
    ASSERT_TRUE(back) << position.x << ' ' << position.y;
    EXPECT_NEAR(back->x, position.x, 1e-7);
    EXPECT_NEAR(back->y, position.y, 1e-7);
    ++positions;
  }
  EXPECT_GT(positions, 50);
}

TEST_P(OpticsOf, TheSpreadSumsToTheAreaThatIsLit) {
  // Sums the areas of triangles on the dome, whose corners are neighboring pixels. Compares this
  // area with the sum of spread() at the centers of squares of pixels.
  const ProjectorOptics optics(dome(7.0), GetParam());
  constexpr int side = 200;
  double spread = 0.0;
  double area = 0.0;
  for (int i = 0; i < side * side; ++i) {
    const int row = i / side;
    const double x = 0.3 + 0.4 * (i - side * row) / side;
    const double y = 0.3 + 0.4 * row / side;
    constexpr double step = 0.4 / side;
    const auto a = optics.dome_point({x, y});
    const auto b = optics.dome_point({x + step, y});
    const auto c = optics.dome_point({x, y + step});
    const auto d = optics.dome_point({x + step, y + step});
    if (!a || !b || !c || !d) {
      continue;
    }
    const auto triangle = [](const Vector3<double>& p, const Vector3<double>& q, const Vector3<double>& r) {
      const Vector3<double> normal = cross(q - p, r - p);
      return 0.5 * std::sqrt(dot(normal, normal));
    };
    area += triangle(*a, *b, *c) + triangle(*b, *c, *d);
    spread += step * step * optics.spread_m2({x + 0.5 * step, y + 0.5 * step});
  }
  EXPECT_GT(area, 0.1);
  EXPECT_NEAR(spread, area, 5e-3 * area);
}

ProjectorSetup mirror() {
  return mirrored(projector_with(Frustum{-9, 9, 6, -5}, {0, 0.1, -3}, {180, 0, 0}), {0, 0, 1.5}, 0.35);
}

std::string name_of(const testing::TestParamInfo<ProjectorSetup>& lens) {
  const char* const names[] = {"Flat", "Fisheye", "Polynomial", "Mirror"};
  return names[lens.index];
}

INSTANTIATE_TEST_SUITE_P(Lenses, OpticsOf, testing::Values(flat(), fisheye(), polynomial(), mirror()), name_of);

TEST(ProjectorOptics, TheBackOfTheSphereIsNotLitFromOutside) {
  const ProjectorOptics optics(dome(5.0), projector_with(Frustum{-30, 30, 20, -20}, {0, 0, 20}, {0, 0, 0}));
  EXPECT_FALSE(optics.raster_position({0, 0, 5}));
  EXPECT_TRUE(optics.raster_position({0, 0, -5}));
}

TEST(ProjectorOptics, AProjectorWithoutALensIsRefusedByName) {
  try {
    const ProjectorOptics optics(dome(5.0), projector_with({}, {0, 0, 0}, {0, 0, 0}));
    FAIL();
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("projector test"), std::string::npos);
  }
}

TEST(ProjectorOptics, LightFromBelowTheRimComesIn) {
  const ProjectorOptics optics(dome(5.0), projector_with(Frustum{-30, 30, 30, -30}, {0, -4, 6}, {0, 45, 0}));
  ASSERT_TRUE(optics.outside());
  const auto point = optics.dome_point({0.5, 0.5});
  ASSERT_TRUE(point);
  EXPECT_TRUE(optics.raster_position(*point));
  EXPECT_GT(point->y, 0.0);
  EXPECT_LT(point->z, 0.0);
}

TEST(ProjectorOptics, LightThatMeetsTheShellFromOutsideLightsNothing) {
  // The ray points upwards. It meets the dome's sphere from outside, at the back above the rim, and
  // without the shell would continue to the front.
  const Vector3<double> from = {0, -1, 6};
  const double pitch = 55.0 * one_degree;
  const ProjectorOptics optics(dome(5.0), projector_with(Frustum{-30, 30, 30, -30}, from, {0, 55, 0}));
  EXPECT_FALSE(optics.dome_point({0.5, 0.5}));
  const double along = from.y * std::sin(pitch) - from.z * std::cos(pitch);
  const double distance = std::sqrt(along * along - dot(from, from) + 25.0) - along;
  EXPECT_FALSE(optics.raster_position(from + distance * Vector3<double>{0.0, std::sin(pitch), -std::cos(pitch)}));
}

TEST(ProjectorOptics, NoProjectorStandsOutsideAboveTheRim) {
  const auto at = [](double tilt_deg, double y) {
    DomeSetup setup = dome(5.0);
    setup.tilt_deg = tilt_deg;
    return ProjectorOptics(setup, projector_with(Frustum{-30, 30, 30, -30}, {0, y, 6}, {0, 35, 0}));
  };
  EXPECT_THROW(at(0.0, 0.1), Error);
  EXPECT_NO_THROW(at(0.0, -0.1));
  EXPECT_NO_THROW(at(10.0, 0.1)) << "the back of the rim is raised";
  EXPECT_THROW(at(-10.0, -0.1), Error) << "and lowered";
}

}  // namespace
}  // namespace ergodome
