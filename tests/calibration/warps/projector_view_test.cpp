#include "calibration/warps/projector_view.h"

#include <gtest/gtest.h>

#include <cmath>

namespace ergodome {
namespace {

// Axes of the dome: x to the right, y up, z to the back. The front is at -z.

void expect_vector(const Vector3<double>& v, double x, double y, double z) {
  EXPECT_NEAR(v.x, x, 1e-12);
  EXPECT_NEAR(v.y, y, 1e-12);
  EXPECT_NEAR(v.z, z, 1e-12);
}

TEST(Orientation, WithoutATurnLooksToTheFront) {
  const ProjectorAxes axes = axes_of({});
  expect_vector(axes.forward, 0, 0, -1);
  expect_vector(axes.right, 1, 0, 0);
  expect_vector(axes.up, 0, 1, 0);
}

TEST(Orientation, YawTurnsToTheRight) {
  const ProjectorAxes axes = axes_of({90, 0, 0});
  expect_vector(axes.forward, 1, 0, 0);
  expect_vector(axes.right, 0, 0, 1);
}

TEST(Orientation, PitchTurnsUp) {
  const ProjectorAxes axes = axes_of({0, 90, 0});
  expect_vector(axes.forward, 0, 1, 0);
  expect_vector(axes.up, 0, 0, 1);
}

TEST(Orientation, RollIsClockwiseSeenFromBehind) {
  const ProjectorAxes axes = axes_of({0, 0, 90});
  expect_vector(axes.up, 1, 0, 0);
  expect_vector(axes.right, 0, -1, 0);
}

TEST(Orientation, PitchComesAfterYaw) {
  // The projector turns to the right (yaw 90°), then up by 45°, so it points halfway between right
  // and up.
  expect_vector(axes_of({90, 45, 0}).forward, std::sqrt(0.5), std::sqrt(0.5), 0);
}

TEST(Orientation, RollComesLastAndLeavesTheAxisInPlace) {
  // After yaw (90°) and pitch (45°), the up axis is (-√½, √½, 0) and the right axis is (0, 0, 1). A
  // roll of 90° moves the up axis to where the right axis was.
  const ProjectorAxes axes = axes_of({90, 45, 90});
  expect_vector(axes.forward, std::sqrt(0.5), std::sqrt(0.5), 0);
  expect_vector(axes.up, 0, 0, 1);
  expect_vector(axes.right, std::sqrt(0.5), -std::sqrt(0.5), 0);
}

TEST(Orientation, AxesAreRightHanded) {
  const ProjectorAxes axes = axes_of({-54.6, 30.1, -35.3});
  expect_vector(cross(axes.right, axes.up) + axes.forward, 0, 0, 0);
  EXPECT_NEAR(dot(axes.right, axes.right), 1.0, 1e-14);
}

TEST(Orientation, IsFoundAgainFromItsAxes) {
  for (const Orientation& turned :
       {Orientation{-54.6, 30.1, -35.3}, Orientation{170, -80, 100}, Orientation{0, 0, 0}}) {
    const Orientation found = orientation_of(axes_of(turned));
    EXPECT_NEAR(found.yaw_deg, turned.yaw_deg, 1e-9);
    EXPECT_NEAR(found.pitch_deg, turned.pitch_deg, 1e-9);
    EXPECT_NEAR(found.roll_deg, turned.roll_deg, 1e-9);
  }
}

TEST(Orientation, StraightUpRollTurnsIntoYaw) {
  const Orientation found = orientation_of(axes_of({30, 90, 20}));
  EXPECT_NEAR(found.pitch_deg, 90.0, 1e-6);
  EXPECT_EQ(found.roll_deg, 0.0);
  const ProjectorAxes again = axes_of(found);
  const ProjectorAxes wanted = axes_of({30, 90, 20});
  EXPECT_NEAR(dot(again.right, wanted.right), 1.0, 1e-12);
}

TEST(Frustum, CornersOfTheRasterLieAtItsHalfAngles) {
  const Frustum frustum{-45, 45, 45, 0};
  const ProjectorAxes axes = axes_of({});
  expect_vector(direction_from_raster(axes, frustum, 0, 0), -1, 1, -1);
  expect_vector(direction_from_raster(axes, frustum, 1, 1), 1, 0, -1);
  expect_vector(direction_from_raster(axes, frustum, 0.5, 0.5), 0, 0.5, -1);
}

TEST(Frustum, TurnsWithItsProjector) {
  // A pitch of 90° points the projector straight up; the top of its picture is then at the back.
  const Frustum frustum{-45, 45, 45, -45};
  expect_vector(direction_from_raster(axes_of({0, 90, 0}), frustum, 0.5, 0), 0, 1, 1);
  expect_vector(direction_from_raster(axes_of({90, 0, 0}), frustum, 1, 0.5), 1, 0, 1);
}

}  // namespace
}  // namespace ergodome
