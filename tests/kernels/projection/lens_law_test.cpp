#include "kernels/projection/lens_law.h"

#include <gtest/gtest.h>

#include <cmath>

#include "kernels/core/angles.h"
#include "tests/support/projections.h"

namespace ergodome {
namespace {

DomeView hemisphere(LensLaw law) {
  DomeView view;
  view.law = law;
  return view;
}

//! Returns the angle from the zenith [deg] of the direction at a position in the image: `radius` is
//! the fraction of the way from the middle of the image to its right side.
double zenith_angle_deg(const DomeView& view, double radius) {
  const Vector3<double> v = direction_from_pixel(make_dome_projection(1000, view), 500.0 + 500.0 * radius, 500.0);
  return std::atan2(std::hypot(v.x, v.z), v.y) * 180.0 / pi;
}

TEST(LensLaws, EquidistantAnglesGrowWithTheRadius) {
  EXPECT_NEAR(zenith_angle_deg(hemisphere(LensLaw::equidistant), 0.5), 45.0, 1e-9);
}

TEST(LensLaws, EquisolidSinesOfHalfTheAngleGrowWithTheRadius) {
  EXPECT_NEAR(zenith_angle_deg(hemisphere(LensLaw::equisolid), 0.5), 2.0 * std::asin(0.5 * std::sqrt(0.5)) * 180.0 / pi,
              1e-9);
}

TEST(LensLaws, StereographicTangentsOfHalfTheAngleGrowWithTheRadius) {
  // If the tangent of half the angle is 1/2, the angle is in the right triangle with the sides 3, 4
  // and 5.
  EXPECT_NEAR(zenith_angle_deg(hemisphere(LensLaw::stereographic), 0.5), std::atan2(4.0, 3.0) * 180.0 / pi, 1e-9);
}

TEST(LensLaws, OrthographicSinesGrowWithTheRadius) {
  EXPECT_NEAR(zenith_angle_deg(hemisphere(LensLaw::orthographic), 0.5), 30.0, 1e-9);
}

TEST(LensLaws, PolynomialRadiusIsTheSumOfItsTerms) {
  const DomeView view = test::measured_lens();
  // At an angle of one radian, all powers of the angle are 1, so the radius is the sum of the
  // coefficients.
  EXPECT_NEAR(zenith_angle_deg(view, 0.67 - 0.011 - 0.0035 + 0.0004), 180.0 / pi, 1e-9);
}

TEST(LensLaws, PolynomialOfOneTermIsTheEquidistantLaw) {
  DomeView view = hemisphere(LensLaw::polynomial);
  view.coefficient[0] = 2.0 / pi;
  for (const double radius : {0.1, 0.5, 0.9, 1.0}) {
    EXPECT_NEAR(zenith_angle_deg(view, radius), 90.0 * radius, 1e-9);
  }
}

TEST(LensLaws, CircleOfAPolynomialEndsAtTheFieldOfView) {
  DomeView view = hemisphere(LensLaw::polynomial);
  view.coefficient[0] = 1.6 / pi;  // 0.8 half widths at 90°
  const Projection p = make_dome_projection(1000, view);
  EXPECT_NEAR(image_coverage(p, 900.0, 500.0), 0.5, 1e-9);
  EXPECT_EQ(image_coverage(p, 902.0, 500.0), 0.0);
  EXPECT_NEAR(direction_from_pixel(p, 900.0, 500.0).y, 0.0, 1e-12);
}

TEST(LensLaws, EveryLawReachesItsFieldOfViewAtTheRim) {
  for (const LensLaw law : {LensLaw::equidistant, LensLaw::equisolid, LensLaw::stereographic, LensLaw::orthographic}) {
    DomeView view = hemisphere(law);
    for (const double field_of_view_deg : {60.0, 120.0, 178.0}) {
      view.field_of_view = field_of_view_deg * pi / 180.0;
      EXPECT_NEAR(zenith_angle_deg(view, 1.0), 0.5 * field_of_view_deg, 1e-8) << static_cast<int>(law);
    }
  }
}

TEST(LensLaws, PolynomialStopsWhereItTurnsBack) {
  // r = t - t³/3 has its maximum at t = 1. The largest half angle is slightly smaller: there the
  // slope falls below a hundredth.
  const double turning[4] = {1.0, -1.0 / 3.0, 0.0, 0.0};
  EXPECT_NEAR(largest_half_angle(LensLaw::polynomial, turning), std::sqrt(0.99), 1e-3);
  const double rising[4] = {0.6, 0.01, 0.0, 0.0};
  EXPECT_EQ(largest_half_angle(LensLaw::polynomial, rising), pi);
  const double falling[4] = {-1.0, 0.0, 0.0, 0.0};
  EXPECT_EQ(largest_half_angle(LensLaw::polynomial, falling), 0.0);
  const double broken[4] = {std::nan(""), 0.0, 0.0, 0.0};
  EXPECT_EQ(largest_half_angle(LensLaw::polynomial, broken), 0.0);
}

TEST(LensLaws, OrthographicLensHasNoImageOfWhatIsBehindIt) {
  double radius = 0.0;
  const double none[4] = {};
  const auto lens = make_fisheye_lens(LensLaw::orthographic, pi, none);
  EXPECT_TRUE(lens_radius(lens, 0.0, 1.0, radius));
  EXPECT_FALSE(lens_radius(lens, -0.1, std::sqrt(0.99), radius));
}

TEST(LensLaws, StereographicLensHasNoImageOfItsAntipode) {
  double radius = 0.0;
  const double none[4] = {};
  EXPECT_FALSE(lens_radius(make_fisheye_lens(LensLaw::stereographic, pi, none), -1.0, 0.0, radius));
}

TEST(DomeFisheye, NadirOfAWholeSphereLiesOnTheRimAtTheFront) {
  double x = 0.0;
  double y = 0.0;
  ASSERT_TRUE(pixel_from_direction(make_dome_projection(100, 2.0 * pi, 0.0), {0.0, -1.0, 0.0}, x, y));
  EXPECT_NEAR(x, 50.0, 1e-9);
  EXPECT_NEAR(y, 100.0, 1e-9);
}

TEST(DomeFisheye, OffCentreViewerSeesAPlaceOfTheDomeWhereItIs) {
  DomeView view;
  view.viewer = {0.5, 0.0, 0.0};
  const Projection p = make_dome_projection(1000, view);
  const Vector3<double> zenith = direction_from_pixel(p, 500.0, 500.0);
  EXPECT_NEAR(zenith.x / zenith.y, -0.5, 1e-12);
  EXPECT_NEAR(zenith.z, 0.0, 1e-12);
  const Vector3<double> right = direction_from_pixel(p, 1000.0, 500.0);
  EXPECT_NEAR(right.x, 1.0, 1e-12);
  const Vector3<double> front = direction_from_pixel(p, 500.0, 1000.0);
  EXPECT_NEAR(front.x / front.z, 0.5, 1e-12);
}

TEST(DomeFisheye, OffCentreViewersRayMeetsTheDomeAtItsPixel) {
  const Projection p = test::off_centre_dome();
  const Vector3<double> viewer = p.dome.viewer;
  const Projection centred = [&] {
    Projection same = p;
    same.dome.off_centre = 0;
    return same;
  }();
  for (const auto& [x, y] : test::image_positions(p, 0.5)) {
    const Vector3<double> position = direction_from_pixel(centred, x, y);
    const Vector3<double> seen = direction_from_pixel(p, x, y);
    // Computes the distance of the position on the dome from the ray, as the distance of a point
    // from a line.
    const Vector3<double> way = position - viewer;
    const Vector3<double> beside = cross(seen, way);
    EXPECT_LT(dot(beside, beside), 1e-24);
    EXPECT_GT(dot(seen, way), 0.0);
  }
}

TEST(DomeFisheye, WhatIsTruncatedIsBlack) {
  DomeView view;
  view.cut_below = 0.25;
  view.cut_above = 0.1;
  const Projection p = make_dome_projection(1000, view);
  EXPECT_EQ(image_coverage(p, 500.5, 740.5), 1.0);
  EXPECT_EQ(image_coverage(p, 500.5, 750.5), 0.0);
  EXPECT_EQ(image_coverage(p, 500.5, 990.5), 0.0);
  EXPECT_EQ(image_coverage(p, 500.5, 98.5), 0.0);
  EXPECT_EQ(image_coverage(p, 500.5, 100.5), 1.0);
}

}  // namespace
}  // namespace ergodome
