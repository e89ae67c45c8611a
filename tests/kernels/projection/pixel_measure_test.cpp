#include "kernels/projection/pixel_measure.h"

#include <gtest/gtest.h>

#include "kernels/core/angles.h"
#include "tests/support/projections.h"

namespace ergodome {
namespace {

using test::lens_of;

//! Returns the solid angle of everything in a picture: the sum over its pixels.
double solid_angle_of(const Projection& p) {
  double sum = 0.0;
  for (int y = 0; y < p.height_px; ++y) {
    for (int x = 0; x < p.width_px; ++x) {
      sum += image_coverage(p, x + 0.5, y + 0.5) * pixel_solid_angle(p, x + 0.5, y + 0.5);
    }
  }
  return sum;
}

//! Compares the pixel centers that a SIMD function computes with those from integer division.
void expect_middles(int width, int rows, int first) {
  using Lanes = WidePack<float>;
  const int count = width * rows;
  Lanes x_px;
  Lanes y_px;
  pixel_middles(width, 7, count, first, x_px, y_px);
  for (int i = 0; i < RealTraits<Lanes>::lane_count; ++i) {
    const int pixel = std::min(first + i, count - 1);
    ASSERT_EQ(lane(x_px, i), static_cast<float>(pixel % width) + 0.5F) << width << " " << first << " " << i;
    const int row = pixel / width;
    ASSERT_EQ(lane(y_px, i), static_cast<float>(row + 7) + 0.5F) << width << " " << first << " " << i;
  }
}

TEST(PixelMiddles, AreThoseOfTheNextPixelsAcrossTheEndsOfRows) {
  for (const int width : {1, 3, 15, 16, 17, 31, 64}) {
    for (int first = 0; first < 5 * width + 3; ++first) {
      expect_middles(width, 5, first);
    }
  }
}

double cap(double half_angle_deg) { return 2.0 * pi * (1.0 - std::cos(half_angle_deg * pi / 180.0)); }

void expect_solid_angle(const Projection& p, double expected) { EXPECT_NEAR(solid_angle_of(p) / expected, 1.0, 2e-3); }

TEST(PixelSolidAngle, OfFisheyesAddsUpToTheirCap) {
  expect_solid_angle(lens_of(LensLaw::equidistant, 180.0), cap(90.0));
  expect_solid_angle(lens_of(LensLaw::equidistant, 250.0), cap(125.0));
  expect_solid_angle(lens_of(LensLaw::equisolid, 180.0), cap(90.0));
  expect_solid_angle(lens_of(LensLaw::stereographic, 180.0), cap(90.0));
  expect_solid_angle(lens_of(LensLaw::stereographic, 300.0), cap(150.0));
  expect_solid_angle(lens_of(LensLaw::orthographic, 160.0), cap(80.0));
  expect_solid_angle(make_dome_projection(1000, test::measured_lens()), cap(90.0));
}

TEST(PixelSolidAngle, OfTheEquisolidLensIsTheSameEverywhere) {
  const Projection p = lens_of(LensLaw::equisolid, 220.0);
  const double middle = pixel_solid_angle(p, 500.0, 500.0);
  for (const double radius : {100.0, 300.0, 499.0}) {
    EXPECT_NEAR(pixel_solid_angle(p, 500.0 + radius, 500.0) / middle, 1.0, 1e-9);
  }
}

TEST(PixelSolidAngle, OfWholeSkiesAddsUpToTheSphere) {
  expect_solid_angle(make_equirectangular_projection(1000, 500), 4.0 * pi);
  expect_solid_angle(make_cube_projection(200, CubeLayout::cross), 4.0 * pi);
  expect_solid_angle(make_cube_projection(200, CubeLayout::strip), 4.0 * pi);
  expect_solid_angle(make_cube_face_projection(200, CubeFace::bottom), 4.0 * pi / 6.0);
}

TEST(PixelSolidAngle, OfHalfASkyAddsUpToHalfTheSphere) {
  expect_solid_angle(make_equirectangular_projection(500, 500, pi), 2.0 * pi);
}

TEST(PixelSolidAngle, OfACylinderAddsUpToItsZone) {
  // The cylinder shows elevations from -45° to 45°.
  expect_solid_angle(make_cylinder_projection(1000, 318, 2.0 * pi, -1.0, 1.0), 4.0 * pi * std::sqrt(0.5));
  expect_solid_angle(make_cylinder_projection(500, 318, 2.0, 0.0, 1.0), 2.0 * std::sqrt(0.5));
}

TEST(PixelSolidAngle, OfAFrustumAddsUpToThatOfItsScreen) {
  // Solid angle of an x by y rectangle at distance 1 with a corner on the axis: atan(xy / √(1 + x²
  // + y²)).
  const auto corner = [](double x, double y) { return std::atan(x * y / std::sqrt(1.0 + x * x + y * y)); };
  const FrustumSides sides = {-0.4, 1.3, 0.9, -0.1};
  const double expected = corner(1.3, 0.9) + corner(0.4, 0.9) + corner(1.3, 0.1) + corner(0.4, 0.1);
  expect_solid_angle(make_frustum_projection(800, 500, sides), expected);
  expect_solid_angle(make_pinhole_projection(500, 500, pi / 2), 4.0 * pi / 6.0);
}

TEST(PixelSolidAngle, OfADomeFromAnywhereOnItsFloorAddsUpToHalfTheSphere) {
  DomeView view;
  view.viewer = {0.5, 0.0, -0.3};
  expect_solid_angle(make_dome_projection(1000, view), 2.0 * pi);
}

TEST(PixelSolidAngle, OfATruncatedDomeIsThatOfTheRest) {
  DomeView view;
  view.cut_below = 0.5;
  expect_solid_angle(make_dome_projection(1000, view), pi);
}

TEST(SkyShare, IsTheSolidAngleThatAnImageShows) {
  for (const Projection& p :
       {make_dome_projection(128, pi, 0.4), make_pinhole_projection(128, 72, 1.0), make_pinhole_projection(64, 64, 0.2),
        make_equirectangular_projection(128, 64), make_equirectangular_projection(64, 64, pi)}) {
    EXPECT_NEAR(sky_share(p), solid_angle_of(p) / (4.0 * pi), 2e-3) << static_cast<int>(p.kind);
  }
}

TEST(PixelAngle, IsThatOfTheMiddle) {
  EXPECT_NEAR(pixel_angle(lens_of(LensLaw::equidistant, 180.0)), pi / 1000, 1e-15);
  EXPECT_NEAR(pixel_angle(lens_of(LensLaw::equisolid, 180.0)), 4.0 * std::sqrt(0.5) / 1000, 1e-12);
  EXPECT_NEAR(pixel_angle(lens_of(LensLaw::stereographic, 180.0)), 4.0 / 1000, 1e-12);
  EXPECT_NEAR(pixel_angle(lens_of(LensLaw::orthographic, 180.0)), 2.0 / 1000, 1e-12);
  EXPECT_NEAR(pixel_angle(make_dome_projection(1000, test::measured_lens())), 2.0 / 0.67 / 1000, 1e-12);
  EXPECT_NEAR(pixel_angle(make_cube_projection(100, CubeLayout::cross)), 2.0 / 100, 1e-15);
  EXPECT_NEAR(pixel_angle(make_cylinder_projection(1000, 300, 3.0, -1.0, 1.0)), 3.0 / 1000, 1e-15);
  EXPECT_NEAR(pixel_angle(make_equirectangular_projection(1000, 1000, pi)), pi / 1000, 1e-15);
}

TEST(PixelAngle, GrowsForAViewerWhoIsNearer) {
  DomeView view;
  view.viewer = {0.0, 0.5, 0.0};
  EXPECT_NEAR(pixel_angle(make_dome_projection(1000, view)), 2.0 * pi / 1000, 1e-12);
}

}  // namespace
}  // namespace ergodome
