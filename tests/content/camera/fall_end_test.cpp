#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "content/camera/camera_path.h"
#include "content/show/reading/show_reader.h"
#include "kernels/core/angles.h"
#include "tests/support/errors.h"

namespace ergodome {
namespace {

using testing::HasSubstr;

constexpr double fall_ends_s = 20.0;
const std::string usual_fall_end = "velocity = { beta = 0.25, toward = [0, 0.3, 1] }\nuntil_s = 20\n";
const std::string begin_keys = "[[camera.key]]\nt_s = 4\nr = 20\ntheta_deg = 75\nphi_deg = 30\n";
const std::string turn_keys = "[[camera.key]]\nt_s = 12\nyaw_deg = 40\n";
const std::string glide_keys =
    "[[camera.key]]\nt_s = 30\nr = 40\ntheta_deg = 60\nphi_deg = 500\npitch_deg = -10\n"
    "[[camera.key]]\nt_s = 50\nr = 60\ntheta_deg = 50\nphi_deg = 900\n";

//! Returns a show of 60 s with a hole of spin 0.9, whose camera falls from 4 s on. `fall` contains
//! further lines of [camera.fall], `keys` the camera keys.
Show ending_show(const std::string& fall, const std::string& keys = begin_keys + turn_keys + glide_keys,
                 const std::string& observer = "zamo") {
  return parse_show("duration_s = 60\n[hole]\nspin = 0.9\n[camera]\nobserver = \"" + observer +
                        "\"\n[camera.fall]\nt_s = 4\nclock = 9\n" + fall + keys,
                    "f.toml");
}

Vector3<double> seen_velocity(const Show& show, double time_s) {
  const CameraPose pose = camera_pose(show, time_s);
  return pose.velocity.value_or(observer_velocity(show.camera.motion, spacetime_of(show), pose.r, pose.theta, {}));
}

//! Returns the roll [rad] of a camera that faces the hole; it is 0 if the camera's up axis points
//! north.
double roll_of(const CameraPose& pose) {
  const glm::dvec3 up = pose.orientation * glm::dvec3(0.0, 1.0, 0.0);
  return std::atan2(up.z, -up.y);
}

TEST(FallEnd, IsWhereTheFallHasBroughtTheCamera) {
  const Show show = ending_show(usual_fall_end);
  const CameraPose pose = camera_pose(show, fall_ends_s);
  const CameraPose next = camera_pose(show, fall_ends_s + 1e-6);
  EXPECT_NEAR(next.r, pose.r, 1e-9);
  EXPECT_NEAR(next.theta, pose.theta, 1e-9);
  EXPECT_NEAR(next.phi, pose.phi, 1e-9);
  EXPECT_GT(std::abs(glm::dot(next.orientation, pose.orientation)), 1.0 - 1e-12);
}

// While the clock of the fall speeds up and slows down, it runs at half of its rate on average:
// each of the two easings costs half of its duration.
TEST(FallEnd, GivesTheCameraTheOwnTimeOfItsClock) {
  const Show show = ending_show(usual_fall_end);
  EXPECT_NEAR(show.camera.orbit->proper_time(60.0), 9.0 * (16.0 - 1.0), 1e-10);
}

TEST(FallEnd, HasNoLeapInPlaceRateVelocityOrView) {
  const Show show = ending_show(usual_fall_end);
  constexpr double step_s = 0.01;
  for (double time_s = fall_ends_s - 2.0; time_s < fall_ends_s + 12.0; time_s += step_s) {
    const CameraPose p[3] = {camera_pose(show, time_s), camera_pose(show, time_s + step_s),
                             camera_pose(show, time_s + 2.0 * step_s)};
    // The limits [1/s²] are larger than two accelerations: that of a clock which runs at about 0.4
    // per second and stops within a second, and those of the camera keys in glide_keys.
    const auto acceleration = [&](auto value) {
      return std::abs(value(p[2]) - 2.0 * value(p[1]) + value(p[0])) / (step_s * step_s);
    };
    EXPECT_LT(acceleration([](const CameraPose& pose) { return std::log(pose.r); }), 2.0) << time_s;
    EXPECT_LT(acceleration([](const CameraPose& pose) { return pose.theta; }), 2.0) << time_s;
    EXPECT_LT(acceleration([](const CameraPose& pose) { return pose.phi; }), 2.0) << time_s;
    const Vector3<double> change = seen_velocity(show, time_s + step_s) - seen_velocity(show, time_s);
    EXPECT_LT(std::sqrt(dot(change, change)), 0.012) << time_s;
    EXPECT_GT(std::abs(glm::dot(p[0].orientation, p[1].orientation)), 1.0 - 1e-4) << time_s;
  }
}

TEST(FallEnd, HasTheCameraExactlyAtTheKeysAfterIt) {
  const Show show = ending_show(usual_fall_end);
  const CameraPose pose = camera_pose(show, 30.0);
  EXPECT_EQ(pose.r, 40.0);
  EXPECT_NEAR(pose.theta, 60.0 * one_degree, 1e-14);
  EXPECT_NEAR(std::remainder(pose.phi - 500.0 * one_degree, 2.0 * pi), 0.0, 1e-12);
  EXPECT_GT(std::abs(glm::dot(pose.orientation, key_orientation(show.camera.keys[2]))), 1.0 - 1e-12);
}

TEST(FallEnd, GoesTheShorterWayRoundToTheFirstKeyAndFromThereAsItIsTold) {
  const Show show = ending_show(usual_fall_end);
  const double end = camera_pose(show, fall_ends_s).phi;
  const double key = camera_pose(show, 30.0).phi;
  EXPECT_LE(std::abs(key - end), pi);
  EXPECT_NEAR(key, 140.0 * one_degree, 1e-12);
  EXPECT_NEAR(camera_pose(show, 50.0).phi - key, 400.0 * one_degree, 1e-12);
}

TEST(FallEnd, GivesTheVelocityBackToTheObserver) {
  const Show show = ending_show(usual_fall_end, begin_keys + turn_keys + glide_keys, "static");
  EXPECT_TRUE(camera_pose(show, fall_ends_s + 0.999).velocity.has_value());
  EXPECT_FALSE(camera_pose(show, fall_ends_s + 1.001).velocity.has_value());
  EXPECT_FALSE(camera_pose(show, 60.0).velocity.has_value());
}

// A fall over the spin axis turns the view upside down. At the next camera key, the view has the
// roll that the key requires.
TEST(FallEnd, RightsAViewThatTheFallHasRolled) {
  const Show show =
      ending_show("velocity = { beta = 0.22, toward = [0, -1, 0] }\nuntil_s = 20\n", begin_keys + glide_keys);
  const double rolled = roll_of(camera_pose(show, fall_ends_s));
  ASSERT_GT(std::abs(rolled), 1.0) << "for the test to tell rolls";
  EXPECT_LT(std::abs(roll_of(camera_pose(show, 25.0))), std::abs(rolled));
  EXPECT_NEAR(roll_of(camera_pose(show, 30.0)), 0.0, 1e-9);
}

TEST(FallEnd, LeavesTheCameraThereWithoutKeysAfterIt) {
  const Show show = ending_show(usual_fall_end, begin_keys + turn_keys);
  const CameraPose there = camera_pose(show, fall_ends_s);
  const CameraPose last = camera_pose(show, 60.0);
  EXPECT_NEAR(last.r, there.r, 1e-12 * there.r);
  EXPECT_GT(std::abs(glm::dot(last.orientation, there.orientation)), 1.0 - 1e-12);
  EXPECT_FALSE(last.velocity.has_value());
}

TEST(FallEnd, StaysForAsLongAsAKeyThereHolds) {
  const Show show =
      ending_show(usual_fall_end, begin_keys + "[[camera.key]]\nt_s = 20\nyaw_deg = 20\nhold_s = 5\n" + glide_keys);
  EXPECT_EQ(camera_pose(show, 24.9).r, camera_pose(show, 20.5).r);
  EXPECT_NE(camera_pose(show, 26.0).r, camera_pose(show, 20.5).r);
}

TEST(FallEnd, IsJoinedToAFallThatHasStoppedBefore) {
  const Show show = ending_show("velocity = \"rain\"\nleast_r = 2\nuntil_s = 25\n");
  ASSERT_TRUE(show.camera.orbit->stop_s().has_value());
  EXPECT_LT(*show.camera.orbit->stop_s(), 25.0);
  EXPECT_NEAR(camera_pose(show, 25.0).r, 2.0, 1e-9);
  EXPECT_NEAR(camera_pose(show, 25.01).r, 2.0, 1e-3);
  EXPECT_EQ(camera_pose(show, 30.0).r, 40.0);
}

TEST(FallEnd, SavesAFallFromTheHorizon) {
  EXPECT_NO_THROW(ending_show("velocity = \"rain\"\nuntil_s = 8\n", begin_keys + glide_keys));
}

TEST(FallEnd, IsAnEndOfAStretchToBake) {
  EXPECT_THAT(path_ends_s(ending_show(usual_fall_end)), testing::IsSupersetOf({4.0, fall_ends_s, 30.0}));
}

TEST(FallEnd, LiesBetweenWhereTheVelocityBeginsToGoOverAndWhereItHasGoneBack) {
  EXPECT_THAT(path_ends_s(ending_show(usual_fall_end)), testing::IsSupersetOf({4.0 - 1.0, fall_ends_s + 1.0}));
}

std::string fall_end_error(const std::string& fall, const std::string& keys = begin_keys + turn_keys + glide_keys,
                           const std::string& observer = "zamo") {
  return test::error_of([&] { ending_show(fall, keys, observer); });
}

TEST(FallEnd, SaysWhatIsWrongWithItAndInWhichLine) {
  const std::string velocity = "velocity = \"static\"\n";
  EXPECT_THAT(fall_end_error(velocity + "until_s = 5\n"), HasSubstr("f.toml:10: camera.fall.until_s is 5 s"));
  EXPECT_THAT(fall_end_error(velocity + "until_s = 70\n"),
              HasSubstr("f.toml:10: camera.fall.until_s is 70 s, but the show ends at 60 s"));
  EXPECT_THAT(fall_end_error(velocity + "until_s = nan\n"), HasSubstr("camera.fall.until_s"));
  EXPECT_THAT(fall_end_error(velocity + "least_r = 1.5\nuntil_s = 25\n", begin_keys, "static"),
              HasSubstr("f.toml:11: camera.fall.until_s ends the fall at r = 1.5 M, where a static observer would"));
}

TEST(FallEnd, WantsPlacesOfTheKeysAfterItAndOfNoneBefore) {
  EXPECT_THAT(fall_end_error(usual_fall_end, begin_keys + turn_keys + "r = 9\n" + glide_keys),
              HasSubstr("f.toml:19: camera.key[1].r is given while the camera falls"));
  EXPECT_THAT(fall_end_error(usual_fall_end, begin_keys + "[[camera.key]]\nt_s = 20.5\n"),
              HasSubstr("f.toml:16: camera.key[1].r is missing"));
  EXPECT_THAT(fall_end_error(usual_fall_end, begin_keys + "[[camera.key]]\nt_s = 20.0000001\nr = 30\n"),
              HasSubstr("f.toml:17: camera.key[1].t_s is not later than the end of the fall"));
  EXPECT_THAT(
      fall_end_error("velocity = \"rain\"\nleast_r = 3\nuntil_s = 25\n",
                     begin_keys + "[[camera.key]]\nt_s = 40\nr = 1.6\n[[camera.key]]\nt_s = 50\nr = 9\n", "static"),
      HasSubstr("camera.key[1].r is 1.6 M"));
}

}  // namespace
}  // namespace ergodome
