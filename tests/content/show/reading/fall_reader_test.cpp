#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "content/camera/camera_path.h"
#include "content/show/reading/show_reader.h"
#include "content/show/unused_keys.h"
#include "kernels/core/angles.h"
#include "tests/support/errors.h"

namespace ergodome {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::Field;
using testing::HasSubstr;

const std::string falling_keys =
    "[[camera.key]]\nt_s = 0\nr = 24\ntheta_deg = 80\n"
    "[[camera.key]]\nt_s = 4\nr = 20\ntheta_deg = 75\nphi_deg = 30\n"
    "[[camera.key]]\nt_s = 12\nyaw_deg = 40\npitch_deg = -10\n";

//! Returns a show of 60 s with a hole of spin 0.9. `fall` contains lines of [camera.fall], `more`
//! the text after this table.
Show falling_show(const std::string& fall, const std::string& more = falling_keys) {
  return parse_show(
      "duration_s = 60\n[hole]\nspin = 0.9\n[camera]\nobserver = \"geodesic\"\n[camera.fall]\n" + fall + more,
      "f.toml");
}

const std::string usual = "t_s = 4\nclock = 6\nvelocity = { beta = 0.2, toward = [0, 0, 2] }\n";

double apart(const Vector3<double>& a, const Vector3<double>& b) {
  const Vector3<double> d = a - b;
  return std::sqrt(dot(d, d));
}

TEST(FallReader, LetsTheCameraGoAtItsKey) {
  const Show show = falling_show(usual);
  const CameraPose pose = camera_pose(show, 4.0);
  EXPECT_NEAR(pose.r, 20.0, 1e-13);
  EXPECT_NEAR(pose.theta, 75.0 * one_degree, 1e-14);
  EXPECT_NEAR(pose.phi, 30.0 * one_degree, 1e-14);
  ASSERT_TRUE(pose.velocity.has_value());
  EXPECT_LT(apart(*pose.velocity, {0.0, 0.0, 0.2}), 1e-14);
}

TEST(FallReader, FollowsItsKeysAndItsObserverBefore) {
  const Show show = falling_show(usual);
  const Show led = parse_show(
      "duration_s = 60\n[hole]\nspin = 0.9\n[camera]\n" + falling_keys.substr(0, falling_keys.rfind("[[")), "led.toml");
  EXPECT_EQ(camera_pose(show, 2.0).r, camera_pose(led, 2.0).r);
  EXPECT_FALSE(camera_pose(show, 2.0).velocity.has_value());
}

TEST(FallReader, HasNoLeapInPlaceVelocityOrViewWhereItBegins) {
  const Show show = falling_show(usual);
  const auto velocity_at = [&](double time_s) {
    const CameraPose pose = camera_pose(show, time_s);
    return pose.velocity.value_or(observer_velocity(show.camera.motion, spacetime_of(show), pose.r, pose.theta, {}));
  };
  for (int i = 0; i < 400; ++i) {
    const double time_s = 2.5 + 0.01 * i;
    const CameraPose now = camera_pose(show, time_s);
    const CameraPose next = camera_pose(show, time_s + 0.01);
    EXPECT_LT(apart(velocity_at(time_s), velocity_at(time_s + 0.01)), 0.005) << time_s;
    EXPECT_LT(std::abs(next.r - now.r) + std::abs(next.phi - now.phi), 0.03) << time_s;
    EXPECT_GT(std::abs(glm::dot(now.orientation, next.orientation)), 1.0 - 1e-4) << time_s;
  }
}

TEST(FallReader, LooksWhereLaterKeysSay) {
  const Show show = falling_show(usual);
  const CameraPose pose = camera_pose(show, 12.0);
  const glm::dquat turned = show.camera.orbit->at(12.0).frame * key_orientation(show.camera.keys[2]);
  EXPECT_NEAR(std::abs(glm::dot(pose.orientation, turned)), 1.0, 1e-14);
}

TEST(FallReader, LooksAtTheHoleAllTheWayWhereNothingElseIsSaid) {
  const Show show = falling_show(usual, falling_keys.substr(0, falling_keys.rfind("[[")));
  for (const double time_s : {5.0, 20.0, 60.0}) {
    const glm::dvec3 forward = camera_pose(show, time_s).orientation * glm::dvec3(0.0, 0.0, -1.0);
    EXPECT_NEAR(forward.x, -1.0, 1e-12);
  }
}

TEST(FallReader, BeginsAtItsObserversVelocityUnlessItIsTold) {
  const Show show = falling_show("t_s = 4\nclock = 6\n");
  EXPECT_LT(apart(*camera_pose(show, 4.0).velocity,
                  observer_velocity(ObserverMotion::geodesic, Spacetime{0.9}, 20.0, 75.0 * one_degree, {})),
            1e-14);
}

TEST(FallReader, WritesBackWhatItRead) {
  const std::string clock =
      "[[animate]]\nnumber = \"camera.fall.clock\"\nkey = [{ t_s = 4, value = 9 }, { t_s = 30, value = 2 }]\n";
  for (const std::string& lines :
       {usual + "ease_s = 2.5\nleast_r = 1.6\n",
        std::string("t_s = 4\nclock = 6\nvelocity = \"rain\"\nleast_r = 2\nuntil_s = 40\n")}) {
    const Show show = falling_show(lines, falling_keys + clock);
    const Show again = parse_show(to_toml(show), "again.toml");
    ASSERT_TRUE(again.camera.fall.has_value());
    EXPECT_EQ(again.camera.fall->ease_s, show.camera.fall->ease_s);
    EXPECT_EQ(again.camera.fall->least_r, show.camera.fall->least_r);
    EXPECT_EQ(again.camera.fall->until_s, show.camera.fall->until_s);
    EXPECT_EQ(again.camera.fall->motion, show.camera.fall->motion);
    EXPECT_NEAR(camera_pose(again, 50.0).r, camera_pose(show, 50.0).r, 1e-9);
    EXPECT_NEAR(camera_pose(again, 50.0).phi, camera_pose(show, 50.0).phi, 1e-9);
  }
}

TEST(FallReader, TakesAClockThatChanges) {
  const Show show =
      falling_show("t_s = 4\nvelocity = \"static\"\n", falling_keys +
                                                           "[[animate]]\nnumber = \"camera.fall.clock\"\n"
                                                           "key = [{ t_s = 4, value = 6 }, { t_s = 10, value = 0 }]\n");
  EXPECT_GT(camera_pose(show, 8.0).r, camera_pose(show, 10.0).r);
  EXPECT_EQ(camera_pose(show, 10.0).r, camera_pose(show, 60.0).r);
}

TEST(FallReader, TakesAClockThatRunsBeforeTheFallAlone) {
  const Show show =
      falling_show("t_s = 4\nvelocity = \"static\"\n", falling_keys +
                                                           "[[animate]]\nnumber = \"camera.fall.clock\"\n"
                                                           "key = [{ t_s = 1, value = 6 }, { t_s = 3, value = 0 }]\n");
  EXPECT_EQ(camera_pose(show, 60.0).r, camera_pose(show, 4.0).r);
}

TEST(FallReader, TellsABakeWhereTheOrbitTurns) {
  const Show show = falling_show(usual);
  const std::vector<double> ends = path_ends_s(show);
  const auto& turns = show.camera.orbit->turns();
  ASSERT_FALSE(turns.empty());
  EXPECT_TRUE(std::ranges::is_sorted(ends));
  EXPECT_NE(std::ranges::find(ends, turns.front().time_s), ends.end());
  EXPECT_TRUE(camera_moves(show));
}

TEST(FallReader, SaysWhenALeastRadiusIsNeverReached) {
  EXPECT_THAT(unused_keys(falling_show(usual + "least_r = 2\n")),
              ElementsAre(AllOf(Field(&UnusedKey::line, 10), Field(&UnusedKey::key, "camera.fall.least_r"))));
  EXPECT_THAT(unused_keys(falling_show("t_s = 4\nclock = 6\nvelocity = \"rain\"\nleast_r = 2\n")), ElementsAre());
}

std::string error_in(const std::string& fall, const std::string& more = falling_keys) {
  return test::error_of([&] { falling_show(fall, more); });
}

TEST(FallReader, NamesWhatIsWrongInItsTable) {
  EXPECT_THAT(error_in("t_s = 4\n"), HasSubstr("f.toml:6: camera.fall.clock is missing"));
  EXPECT_THAT(error_in("t_s = 4\nclock = 0\n"), HasSubstr("f.toml:8: camera.fall.clock is never above 0"));
  EXPECT_THAT(error_in("t_s = 4\nclock = -1\n"), HasSubstr("camera.fall.clock is -1"));
  EXPECT_THAT(error_in("t_s = 4\nclock = nan\n"), HasSubstr("camera.fall.clock"));
  EXPECT_THAT(error_in("t_s = 5\nclock = 6\n"),
              HasSubstr("f.toml:7: camera.fall.t_s is 5 s, but the camera has no key"));
  EXPECT_THAT(error_in("t_s = 4\nclock = 6\nvelocity = { beta = 1, toward = [1, 0, 0] }\n"),
              HasSubstr("camera.fall.velocity.beta"));
  EXPECT_THAT(error_in("t_s = 4\nclock = 6\nvelocity = { beta = 0.1, toward = [nan, 0, 0] }\n"),
              HasSubstr("camera.fall.velocity.toward"));
  EXPECT_THAT(error_in(usual + "least_r = 1.436\n"), HasSubstr("f.toml:10: camera.fall.least_r is 1.436 M"));
  EXPECT_THAT(error_in(usual + "least_r = 20\n"), HasSubstr("camera.fall.least_r is 20 M"));
  EXPECT_THAT(error_in("t_s = 4\nclock = 1e9\nvelocity = { beta = 0.2, toward = [0, 0, 1] }\n"),
              HasSubstr("camera.fall.clock is so fast"));
}

TEST(FallReader, RefusesAFallIntoTheHoleWithItsTimeAndTheRemedy) {
  EXPECT_THAT(error_in("t_s = 4\nclock = 6\nvelocity = \"rain\"\n"),
              AllOf(HasSubstr("f.toml:7: camera.fall.t_s starts a fall that reaches the horizon at 1"),
                    HasSubstr("least_r = 1.508")));
}

TEST(FallReader, RefusesWhatDoesNotGoWithAFall) {
  EXPECT_THAT(error_in(usual, falling_keys + "r = 9\n"),
              HasSubstr("f.toml:23: camera.key[2].r is given while the camera falls"));
  EXPECT_THAT(error_in(usual, falling_keys + "[[animate]]\nnumber = \"hole.spin\"\nkey = [{ t_s = 0, value = 0.5 }]\n"),
              HasSubstr("while the spin of the hole is animated"));
  EXPECT_THAT(error_in("t_s = 70\nclock = 6\n",
                       falling_keys.substr(0, falling_keys.rfind("[[")) + "[[camera.key]]\nt_s = 70\nr = 9\n"),
              HasSubstr("camera.fall.t_s is 70 s, but the show ends at 60 s"));
  EXPECT_THAT(error_in("t_s = 4\nclock = 6\nvelocity = \"retrograde\"\n", "[[camera.key]]\nt_s = 4\nr = 3\n"),
              HasSubstr("faster than light"));
}

}  // namespace
}  // namespace ergodome
