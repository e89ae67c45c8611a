#include "render/eyes/stereo_rig.h"

#include <gtest/gtest.h>

#include <cmath>

#include "kernels/core/angles.h"
#include "kernels/spacetime/kerr/kerr.h"

namespace ergodome {
namespace {

//! The axes of a view that faces the hole: right is e_φ, up is -e_θ, back is e_r.
constexpr double at_hole[3][3] = {{0, 0, 1}, {0, -1, 0}, {1, 0, 0}};

double position(const EyeEvent& eye, int axis) {
  const double across = eye.r * std::sin(eye.theta);
  return axis == 0 ? across * std::cos(eye.phi) : axis == 1 ? across * std::sin(eye.phi) : eye.r * std::cos(eye.theta);
}

TEST(StereoRig, BaselineZeroLeavesTheHeadInPlace) {
  const EyeEvent eye = eye_event(Spacetime{0.9}, 8.0, 1.1, 7.3, at_hole, {0.0, 0.0, 0.0}, {1.5});
  EXPECT_NEAR(eye.r, 8.0, 1e-14);
  EXPECT_NEAR(eye.theta, 1.1, 1e-14);
  EXPECT_NEAR(eye.phi, 7.3, 1e-14);
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) {
      EXPECT_NEAR(eye.frame_from_view[i][j], at_hole[i][j], 1e-14);
    }
  }
}

TEST(StereoRig, SmallOffsetHasItsProperLength) {
  // For an eye that is displaced along φ: the proper length is √(A/Σ) sinθ dφ.
  const double a = 0.9;
  const EyeEvent eye = eye_event(Spacetime{a}, 4.0, 1.1, 0.0, at_hole, {1e-6, 0.0, 0.0}, {1.5});
  const double factor = kerr_functions(Spacetime{a}, 4.0, 1.1).circumference_factor;
  EXPECT_NEAR(factor * std::sin(1.1) * eye.phi, 1e-6, 1e-15);
  // For an eye that is displaced along r: the proper length is √(Σ/Δ) dr.
  const double sideways[3][3] = {{1, 0, 0}, {0, -1, 0}, {0, 0, -1}};
  const KerrFunctions f = kerr_functions(Spacetime{a}, 4.0, 1.1);
  const EyeEvent outer = eye_event(Spacetime{a}, 4.0, 1.1, 0.0, sideways, {1e-6, 0.0, 0.0}, {1.5});
  EXPECT_NEAR(std::sqrt(f.sigma / f.delta) * (outer.r - 4.0), 1e-6, 1e-14);
}

TEST(StereoRig, FarFromTheHoleOffsetsAreThoseOfFlatSpace) {
  const EyeEvent left = eye_event(Spacetime{0.9}, 1e6, 1.0, 0.5, at_hole, {-10.0, 0.0, 0.0}, {1.5});
  const EyeEvent right = eye_event(Spacetime{0.9}, 1e6, 1.0, 0.5, at_hole, {10.0, 0.0, 0.0}, {1.5});
  double squared = 0.0;
  for (int axis = 0; axis < 3; ++axis) {
    squared += std::pow(position(right, axis) - position(left, axis), 2);
  }
  EXPECT_NEAR(std::sqrt(squared), 20.0, 1e-4);
}

TEST(StereoRig, AxesStayOrthonormalForBaselinesLargerThanTheDistance) {
  for (const double offset : {0.1, 8.0, 100.0, -1e4}) {
    const EyeEvent eye = eye_event(Spacetime{0.9}, 8.0, 1.1, 0.3, at_hole, {offset, 0.0, 0.0}, {1.5});
    EXPECT_TRUE(std::isfinite(eye.r) && eye.r >= 1.5);
    for (int i = 0; i < 3; ++i) {
      for (int j = 0; j < 3; ++j) {
        double sum = 0.0;
        for (int k = 0; k < 3; ++k) {
          sum += eye.frame_from_view[i][k] * eye.frame_from_view[j][k];
        }
        EXPECT_NEAR(sum, i == j ? 1.0 : 0.0, 1e-12);
      }
    }
  }
}

TEST(StereoRig, EyeThatWouldFallIntoTheHoleWaitsOutside) {
  const double towards[3][3] = {{-1, 0, 0}, {0, -1, 0}, {0, 0, 1}};
  EXPECT_EQ(eye_event(Spacetime{0.9}, 3.0, 1.0, 0.0, towards, {4.5, 0.0, 0.0}, {1.5}).r, 1.5);
}

TEST(StereoRig, WorksOnTheSpinAxis) {
  const EyeEvent eye = eye_event(Spacetime{0.9}, 5.0, 0.0, 0.2, at_hole, {0.1, 0.0, 0.0}, {1.5});
  EXPECT_GT(eye.theta, 0.0);
  EXPECT_TRUE(std::isfinite(eye.phi));
  EXPECT_NEAR(eye.frame_from_view[0][2], 1.0, 1e-3);
}

TEST(StereoRig, KeepsCountOfTheTurnsOfPhi) {
  const double many = 1000.0 * 2.0 * pi + 0.4;
  EXPECT_NEAR(eye_event(Spacetime{0.9}, 8.0, 1.1, many, at_hole, {0.01, 0.0, 0.0}, {1.5}).phi, many, 0.01);
}

}  // namespace
}  // namespace ergodome
