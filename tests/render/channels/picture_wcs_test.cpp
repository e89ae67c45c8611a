#include "render/channels/picture_wcs.h"

#include <gtest/gtest.h>

#include <cmath>

#include "kernels/core/angles.h"
#include "kernels/projection/make_projection.h"
#include "kernels/projection/pixel_measure.h"

// Converts pixels to directions only by the formulas of the FITS standard: Calabretta & Greisen,
// Representations of celestial coordinates in FITS, Astronomy & Astrophysics 395 (2002). Equation
// numbers below refer to this paper.
namespace ergodome {
namespace {

struct NativePosition {
  double phi;
  double theta;  // native latitude [rad]
};

//! Returns the native latitude in a zenithal projection at the distance R = `radius_deg` from its
//! pole.
double zenithal_latitude(const PictureWcs& wcs, double radius_deg) {
  const double r = one_degree * radius_deg;
  if (wcs.code == "TAN") {
    return std::atan2(1.0, r);  // eq. 55
  }
  if (wcs.code == "STG") {
    return 0.5 * pi - 2.0 * std::atan(0.5 * r);  // eq. 58
  }
  if (wcs.code == "SIN") {
    return std::acos(r);  // eq. 61 with ξ = η = 0
  }
  if (wcs.code == "ARC") {
    return 0.5 * pi - r;  // eq. 67
  }
  if (wcs.code == "ZEA") {
    return 0.5 * pi - 2.0 * std::asin(0.5 * r);  // eq. 70
  }
  // The projection ZPN is a polynomial (eq. 72); its inverse is found by bisection.
  double low = 0.0;
  double high = pi;
  for (int i = 0; i < 200; ++i) {
    const double middle = 0.5 * (low + high);
    double sum = 0.0;
    for (const auto& [m, coefficient] : wcs.pv2) {
      sum += coefficient * std::pow(middle, m);
    }
    (sum < r ? low : high) = middle;
  }
  return 0.5 * pi - low;
}

NativePosition native_position(const PictureWcs& wcs, double x, double y) {
  if (wcs.code == "CAR") {
    return {one_degree * x, one_degree * y};  // eqs. 83, 84
  }
  if (wcs.code == "CYP") {
    const double mu = wcs.pv2[0].second;
    const double lambda = wcs.pv2[1].second;
    const double eta = one_degree * y / (mu + lambda);  // eqs. 75 to 77
    return {one_degree * x / lambda, std::atan2(eta, 1.0) + std::asin(eta * mu / std::hypot(eta, 1.0))};
  }
  return {std::atan2(x, -y), zenithal_latitude(wcs, std::hypot(x, y))};  // eqs. 14, 15
}

//! Returns longitude and latitude of a pixel [rad]. FITS counts columns and rows from 1, rows from
//! the bottom.
NativePosition world_of(const PictureWcs& wcs, double column, double row) {
  const double x = wcs.cdelt[0] * (column - wcs.crpix[0]);
  const double y = wcs.cdelt[1] * (row - wcs.crpix[1]);
  const NativePosition native = native_position(wcs, x, y);
  if (!wcs.lonpole_deg) {
    return native;  // a cylindrical projection at (0, 0): its native system is the celestial one
  }
  // Rotates native to celestial coordinates (eq. 2). The native pole of a zenithal projection is at
  // CRVAL.
  const double pole = one_degree * wcs.crval[1];
  const double turn = native.phi - one_degree * *wcs.lonpole_deg;
  const double alpha =
      one_degree * wcs.crval[0] +
      std::atan2(-std::cos(native.theta) * std::sin(turn),
                 std::sin(native.theta) * std::cos(pole) - std::cos(native.theta) * std::sin(pole) * std::cos(turn));
  const double delta =
      std::asin(std::sin(native.theta) * std::sin(pole) + std::cos(native.theta) * std::cos(pole) * std::cos(turn));
  return {alpha, delta};
}

//! Compares the directions of pixels by the FITS formulas with those of the projection, all over a
//! picture.
void expect_directions(const Projection& projection, const char* code) {
  const std::optional<PictureWcs> wcs = picture_wcs(projection);
  ASSERT_TRUE(wcs);
  EXPECT_EQ(wcs->code, code);
  int compared = 0;
  for (int row = 0; row < projection.height_px; row += 3) {
    for (int column = 0; column < projection.width_px; column += 3) {
      if (!(image_coverage(projection, column + 0.5, row + 0.5) >= 1.0)) {
        continue;
      }
      const Vector3<double> ray = direction_from_pixel(projection, column + 0.5, row + 0.5);
      const NativePosition world = world_of(*wcs, column + 1.0, projection.height_px - row);
      // Longitude 0 is forward (-z), and longitude increases to the right (x); latitude increases
      // upwards (y).
      EXPECT_NEAR(std::cos(world.theta) * std::sin(world.phi), ray.x, 1e-7) << column << " " << row;
      EXPECT_NEAR(std::sin(world.theta), ray.y, 1e-7) << column << " " << row;
      EXPECT_NEAR(-std::cos(world.theta) * std::cos(world.phi), ray.z, 1e-7) << column << " " << row;
      ++compared;
    }
  }
  EXPECT_GT(compared, 50);
}

Projection dome(LensLaw law, double field_deg, double tilt_deg) {
  DomeView view;
  view.law = law;
  view.field_of_view = one_degree * field_deg;
  view.tilt = one_degree * tilt_deg;
  const double fisheye[4] = {0.7, 0.02, -0.003, 0.0005};
  std::copy_n(fisheye, 4, view.coefficient);
  return make_dome_projection(64, view);
}

TEST(PictureWcs, SaysWhereThePixelsOfScreensLook) {
  expect_directions(make_pinhole_projection(64, 40, 70.0 * one_degree), "TAN");
  expect_directions(make_frustum_projection(60, 50, {-0.9, 0.4, 0.7, -0.2}), "TAN");
  expect_directions(seen_from_outside(make_frustum_projection(60, 50, {-0.9, 0.4, 0.7, -0.2})), "TAN");
}

TEST(PictureWcs, SaysWhereThePixelsOfDomesLook) {
  expect_directions(dome(LensLaw::equidistant, 180.0, 0.0), "ARC");
  expect_directions(dome(LensLaw::equidistant, 220.0, 25.0), "ARC");
  expect_directions(seen_from_outside(dome(LensLaw::equidistant, 180.0, 25.0)), "ARC");
  expect_directions(dome(LensLaw::equisolid, 200.0, 90.0), "ZEA");
  expect_directions(dome(LensLaw::stereographic, 180.0, 10.0), "STG");
  expect_directions(dome(LensLaw::orthographic, 150.0, 10.0), "SIN");
  expect_directions(dome(LensLaw::polynomial, 160.0, 30.0), "ZPN");
}

TEST(PictureWcs, SaysWhereThePixelsOfSpheresAndCylindersLook) {
  expect_directions(make_equirectangular_projection(64, 32), "CAR");
  expect_directions(make_equirectangular_projection(40, 32, 1.25 * pi), "CAR");
  expect_directions(seen_from_outside(make_equirectangular_projection(64, 32)), "CAR");
  expect_directions(make_cylinder_projection(64, 30, 1.5 * pi, -0.3, 0.8), "CYP");
}

TEST(PictureWcs, HasNoneForWhatFitsHasNot) {
  EXPECT_FALSE(picture_wcs(make_cube_projection(16, CubeLayout::cross)));
  DomeView view;
  view.viewer = {0.1, 0.0, 0.0};
  EXPECT_FALSE(picture_wcs(make_dome_projection(64, view)));
}

}  // namespace
}  // namespace ergodome
