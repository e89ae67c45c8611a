#include <gtest/gtest.h>

#include <cmath>

#include "content/fall/rain_pose.h"
#include "tests/app/test_flights.h"

namespace ergodome {
namespace {

using namespace test;  // NOLINT(google-build-using-namespace): flights of tests

//! A camera that falls through the horizon of a hole of spin 0.9, and sideways; the horizon is at 1.4359 M.
Show falling_through(double clock) {
  return parse_show("duration_s = 200\n[hole]\nspin = 0.9\n[camera.fall]\nclock = " + std::to_string(clock) +
                        "\nvelocity = { beta = 0.4, toward = [-1, 0.4, 0.7] }\nleast_r = 0.8\n[[camera.key]]\nr = 8\n"
                        "theta_deg = 70\n",
                    "through.toml");
}

//! A navigator that has followed the path to a time.
Navigator follower(const Show& show, double until_s) {
  Navigator navigator(show);
  for (double time_s = frame_s; time_s < until_s; time_s += frame_s) {
    navigator.advance(frame_s, {}, camera_pose(show, time_s));
  }
  navigator.advance(frame_s, {}, camera_pose(show, until_s));
  return navigator;
}

//! The view in directions that do not turn, with axes that are boosted from the ZAMO.
glm::dquat view_of(const CameraPose& pose) { return place_of(in_zamo_frame(pose, 0.9)).view; }

TEST(FlightThroughHorizon, BeginsWithTheViewOfThePath) {
  const Show show = falling_through(0.5);
  Navigator navigator = follower(show, 12.0);
  const CameraPose path = camera_pose(show, 12.0);
  ASSERT_GT(angle_between(place_of(path).view, view_of(path)), 0.05);
  navigator.leave_path();
  EXPECT_LT(angle_between(place_of(navigator.pose()).view, view_of(path)), 1e-12);
  for (int i = 0; i < 30; ++i) {
    navigator.advance(frame_s, {}, path);
  }
  // As the path turned on its own, and no faster.
  EXPECT_LT(angle_between(place_of(navigator.pose()).view, view_of(path)), 0.05);
}

TEST(FlightThroughHorizon, ReturnsToTheViewOfThePath) {
  const Show show = falling_through(0.1);
  Navigator navigator = follower(show, 10.0);
  navigator.leave_path();
  double time_s = 10.0;
  const auto go_on = [&](const Steering& steering) {
    time_s += frame_s;
    navigator.advance(frame_s, holding(steering), camera_pose(show, time_s));
  };
  for (int i = 0; i < 60; ++i) {
    go_on(forward_only(-1.0));
  }
  navigator.return_to_path();
  glm::dquat before = view_of(navigator.pose());
  double greatest = 0.0;
  while (navigator.course() != Navigator::Course::path && time_s < 60.0) {
    go_on({});
    const glm::dquat now = view_of(navigator.pose());
    greatest = std::max(greatest, angle_between(before, now));
    before = now;
  }
  ASSERT_EQ(navigator.course(), Navigator::Course::path);
  EXPECT_LT(greatest, 0.03);
}

TEST(FlightThroughHorizon, FromWithinBeginsWhereTheShowDid) {
  const Show show = falling_through(1.0);
  Navigator navigator = follower(show, *show.camera.orbit->horizon_s() + 0.5);
  ASSERT_LT(navigator.pose().r, horizon_radius(0.9));
  navigator.leave_path();
  EXPECT_EQ(navigator.course(), Navigator::Course::free);
  EXPECT_NEAR(navigator.pose().r, 8.0, 1e-9);
}

TEST(FlightThroughHorizon, ReturnsAtOnceToAPathThatIsWithin) {
  const Show show = falling_through(1.0);
  const CameraPose within = camera_pose(show, *show.camera.orbit->horizon_s() + 0.5);
  Navigator navigator(show);
  navigator.advance(frame_s, {}, within);
  navigator.leave_path();
  navigator.advance(frame_s, {}, within);
  navigator.return_to_path();
  navigator.advance(frame_s, {}, within);
  EXPECT_EQ(navigator.course(), Navigator::Course::path);
  EXPECT_EQ(navigator.pose().r, within.r);
}

}  // namespace
}  // namespace ergodome
