#include "content/camera_path.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/gtc/quaternion.hpp>

#include "content/show_reader.h"

namespace ergodome {
namespace {

Show path_show() {
  return parse_show(R"(
duration_s = 10
[camera]
[[camera.key]]
t_s = 0
r = 30
theta_deg = 80
[[camera.key]]
t_s = 4
r = 10
theta_deg = 90
phi_deg = 300
yaw_deg = 40
[[camera.key]]
t_s = 6
r = 9
theta_deg = 60
phi_deg = 720
yaw_deg = 170
pitch_deg = 20
[[camera.key]]
t_s = 10
r = 2.1
theta_deg = 90
phi_deg = 700
roll_deg = 30
)",
                    "path.toml");
}

TEST(CameraPath, PassesThroughItsKeys) {
  const Show show = path_show();
  for (const CameraKey& key : show.camera.keys) {
    const CameraPose pose = camera_pose(show, key.time_s);
    EXPECT_NEAR(pose.r, key.r, 1e-12);
    EXPECT_NEAR(pose.theta, key.theta, 1e-12);
    EXPECT_NEAR(pose.phi, key.phi, 1e-12);
    EXPECT_NEAR(std::abs(glm::dot(pose.orientation, key_orientation(key))), 1.0, 1e-12);
  }
}

TEST(CameraPath, HoldsBeforeTheFirstAndAfterTheLastKey) {
  const Show show = path_show();
  EXPECT_EQ(camera_pose(show, -5.0).r, 30.0);
  EXPECT_EQ(camera_pose(show, 1e9).r, 2.1);
}

TEST(CameraPath, VelocityIsContinuousAtEveryKey) {
  const Show show = path_show();
  const double h = 1e-4;
  for (const CameraKey& key : show.camera.keys) {
    const CameraPose before = camera_pose(show, key.time_s - h);
    const CameraPose at = camera_pose(show, key.time_s);
    const CameraPose after = camera_pose(show, key.time_s + h);
    EXPECT_NEAR((after.r - 2.0 * at.r + before.r) / h, 0.0, 0.05);
    EXPECT_NEAR((after.theta - 2.0 * at.theta + before.theta) / h, 0.0, 0.05);
    EXPECT_NEAR((after.phi - 2.0 * at.phi + before.phi) / h, 0.0, 0.05);
    const glm::dquat first = glm::inverse(before.orientation) * at.orientation;
    const glm::dquat second = glm::inverse(at.orientation) * after.orientation;
    EXPECT_NEAR(glm::length(glm::dvec3(first.x - second.x, first.y - second.y, first.z - second.z)) / h, 0.0, 0.05);
  }
}

TEST(CameraPath, NeverLeavesTheRangeOfItsNeighbourKeys) {
  const Show show = path_show();
  for (double t = 0.0; t <= 10.0; t += 0.01) {
    const CameraPose pose = camera_pose(show, t);
    EXPECT_GE(pose.r, 2.1 - 1e-12);
    EXPECT_LE(pose.r, 30.0 + 1e-12);
    EXPECT_NEAR(glm::length(pose.orientation), 1.0, 1e-12);
  }
}

TEST(CameraPath, TurnsTheShortWay) {
  const Show show = path_show();
  double swept = 0.0;
  for (double t = 4.0; t < 6.0; t += 0.01) {
    const double cosine = std::abs(glm::dot(camera_pose(show, t).orientation, camera_pose(show, t + 0.01).orientation));
    swept += 2.0 * std::acos(std::min(1.0, cosine));
  }
  EXPECT_LT(swept, 1.2 * 140.0 / 57.29577951308232);
}

TEST(CameraPath, LookingAtTheHoleRightIsAlongTheOrbitAndUpIsNorth) {
  const glm::dquat look = key_orientation(CameraKey{});
  EXPECT_NEAR(glm::length(look * glm::dvec3(0.0, 0.0, -1.0) - glm::dvec3(-1.0, 0.0, 0.0)), 0.0, 1e-14);
  EXPECT_NEAR(glm::length(look * glm::dvec3(1.0, 0.0, 0.0) - glm::dvec3(0.0, 0.0, 1.0)), 0.0, 1e-14);
  EXPECT_NEAR(glm::length(look * glm::dvec3(0.0, 1.0, 0.0) - glm::dvec3(0.0, -1.0, 0.0)), 0.0, 1e-14);
}

TEST(CameraPath, YawTurnsRightPitchUpAndRollClockwise) {
  CameraKey key;
  key.yaw = 0.1;
  EXPECT_GT((key_orientation(key) * glm::dvec3(0.0, 0.0, -1.0)).z, 0.0);
  key = {};
  key.pitch = 0.1;
  EXPECT_LT((key_orientation(key) * glm::dvec3(0.0, 0.0, -1.0)).y, 0.0);
  key = {};
  key.roll = 0.1;
  EXPECT_GT((key_orientation(key) * glm::dvec3(0.0, 1.0, 0.0)).z, 0.0);
}

TEST(CameraPath, LookingStraightNorthHasAnUp) {
  CameraKey key;
  key.look = {LookTarget::Kind::direction, {0.0, -2.0, 0.0}};
  const glm::dquat look = key_orientation(key);
  EXPECT_NEAR(glm::length(look), 1.0, 1e-12);
  EXPECT_NEAR((look * glm::dvec3(0.0, 0.0, -1.0)).y, -1.0, 1e-12);
}

}  // namespace
}  // namespace ergodome
