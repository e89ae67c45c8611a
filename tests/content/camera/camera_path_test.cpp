#include "content/camera/camera_path.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <glm/gtc/quaternion.hpp>
#include <string>
#include <tuple>
#include <vector>

#include "content/show/reading/show_reader.h"

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

//! Returns log r, θ, φ of the camera, and its rotation relative to its orientation at a key.
std::array<double, 6> seen_from(const CameraKey& key, const CameraPose& pose) {
  glm::dquat turn = glm::inverse(key_orientation(key)) * pose.orientation;
  turn = turn.w < 0.0 ? -turn : turn;
  return {std::log(pose.r), pose.theta, pose.phi, turn.x, turn.y, turn.z};
}

TEST(CameraPath, SpeedAndAccelerationAreTheSameOnBothSidesOfEveryKey) {
  const Show show = path_show();
  const double h = 1e-3;
  for (const CameraKey& key : show.camera.keys) {
    std::array<std::array<double, 6>, 7> at{};
    for (std::size_t i = 0; i < at.size(); ++i) {
      at[i] = seen_from(key, camera_pose(show, key.time_s + (static_cast<double>(i) - 3.0) * h));
    }
    for (std::size_t k = 0; k < 6; ++k) {
      // Derivatives before and after the key, by one-sided differences with errors of order h².
      const double speed_before = (3.0 * at[3][k] - 4.0 * at[2][k] + at[1][k]) / (2.0 * h);
      const double speed_after = (-3.0 * at[3][k] + 4.0 * at[4][k] - at[5][k]) / (2.0 * h);
      const double change_before = (2.0 * at[3][k] - 5.0 * at[2][k] + 4.0 * at[1][k] - at[0][k]) / (h * h);
      const double change_after = (2.0 * at[3][k] - 5.0 * at[4][k] + 4.0 * at[5][k] - at[6][k]) / (h * h);
      EXPECT_NEAR(speed_before, speed_after, 1e-4) << key.time_s << " part " << k;
      EXPECT_NEAR(change_before, change_after, 2e-3) << key.time_s << " part " << k;
    }
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

//! Returns a show whose camera moves outwards. Each key is (t, r, more); `more` contains further
//! lines of the key.
Show path_of(const std::vector<std::tuple<double, double, std::string>>& keys) {
  std::string text = "[camera]\n";
  for (const auto& [t, r, more] : keys) {
    text += "[[camera.key]]\nt_s = " + std::to_string(t) + "\nr = " + std::to_string(r) + "\n" + more;
  }
  return parse_show(text, "path.toml");
}

TEST(CameraPath, RunsMonotonouslyBetweenKeysHoweverUneven) {
  const Show show = path_of({{0, 5, ""}, {0.1, 5.1, ""}, {10, 40, ""}, {10.2, 41, ""}, {30, 41.5, ""}, {31, 400, ""}});
  double last = 0.0;
  for (double t = 0.0; t <= 31.0; t += 0.001) {
    const double r = camera_pose(show, t).r;
    ASSERT_GE(r, last * (1.0 - 1e-15)) << t;
    last = r;
  }
}

TEST(CameraPath, StaysAsLongAsAKeyHolds) {
  const Show show = path_of({{0, 5, ""}, {2, 10, "yaw_deg = 30\nhold_s = 3\n"}, {8, 20, "yaw_deg = 80\n"}});
  const glm::dquat held = key_orientation(show.camera.keys[1]);
  for (const double t : {2.0, 2.1, 4.0, 5.0}) {
    EXPECT_EQ(camera_pose(show, t).r, 10.0) << t;
    EXPECT_EQ(camera_pose(show, t).orientation, held) << t;
  }
  // The camera comes to rest and departs smoothly: near the rest, r changes with the third power of
  // time.
  EXPECT_NEAR(camera_pose(show, 1.99).r, 10.0, 1e-4);
  EXPECT_NEAR(camera_pose(show, 5.01).r, 10.0, 1e-4);
  EXPECT_GT(camera_pose(show, 6.5).r, 13.0);
}

TEST(CameraPath, OfTwoKeysIsTheQuinticThatRestsAtBoth) {
  const Show show = path_of({{0, 5, ""}, {2, 10, ""}});
  for (const double t : {0.2, 0.7, 1.0, 1.9}) {
    const double x = 0.5 * t;
    EXPECT_NEAR(camera_pose(show, t).r, 5.0 * std::exp2(x * x * x * (10.0 - 15.0 * x + 6.0 * x * x)), 1e-12);
  }
}

TEST(CameraPath, EasesOnlyWhereItIsTold) {
  const auto middle = [](const std::string& ease) {
    return camera_pose(path_of({{0, 1.0e3, "ease = \"" + ease + "\"\n"}, {2, 8.0e3, ""}}), 1.0).r / 1e3;
  };
  EXPECT_NEAR(middle("linear"), std::sqrt(8.0), 1e-12);
  EXPECT_NEAR(middle("smooth"), std::sqrt(8.0), 1e-12);
  EXPECT_NEAR(middle("in"), std::pow(8.0, 0.125), 1e-12);   // t³
  EXPECT_NEAR(middle("out"), std::pow(8.0, 0.875), 1e-12);  // 1 - (1 - t)³
}

TEST(CameraPath, InTheMiddleComesToRestWhereItIsTold) {
  const auto step_at_two = [](const std::string& before, const std::string& after) {
    const Show show = path_of({{0, 5, before}, {2, 10, after}, {4, 20, ""}});
    return camera_pose(show, 2.005).r - camera_pose(show, 1.995).r;
  };
  EXPECT_GT(step_at_two("", ""), 0.02);
  EXPECT_LT(step_at_two("ease = \"out\"\n", ""), 1e-5);
  EXPECT_LT(step_at_two("", "ease = \"in\"\n"), 1e-5);
  EXPECT_LT(step_at_two("", "ease = \"in_out\"\n"), 1e-5);
}

TEST(CameraPath, RollsOnWithoutTurningBack) {
  const Show show =
      path_of({{0, 9, ""}, {2, 9, "roll_deg = 10\n"}, {3, 9, "roll_deg = 100\n"}, {9, 9, "roll_deg = 110\n"}});
  double last = -1e-12;
  for (double t = 0.0; t < 9.0; t += 0.01) {
    const glm::dquat turn = glm::inverse(key_orientation(show.camera.keys[0])) * camera_pose(show, t).orientation;
    const double rolled = 2.0 * std::atan2(std::abs(turn.z), std::abs(turn.w));
    ASSERT_GE(rolled, last - 1e-12) << t;
    last = rolled;
  }
}

TEST(CameraPath, IsTheSameABillionSecondsLater) {
  const Show now = path_show();
  Show later = now;
  for (CameraKey& key : later.camera.keys) {
    key.time_s += 1e9;
  }
  double phi = camera_pose(later, 1e9).phi;
  for (int i = 1; i <= 640; ++i) {
    const double t = i / 64.0;  // such times are exact in binary
    const CameraPose pose = camera_pose(later, 1e9 + t);
    const CameraPose expected = camera_pose(now, t);
    EXPECT_NEAR(pose.r, expected.r, 1e-9 * expected.r);
    EXPECT_NEAR(pose.phi - phi, expected.phi - camera_pose(now, t - 1.0 / 64.0).phi, 1e-9 * std::abs(expected.phi));
    EXPECT_NEAR(std::abs(glm::dot(pose.orientation, expected.orientation)), 1.0, 1e-14);
    phi = pose.phi;
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
