#include <gtest/gtest.h>

#include <cmath>

#include "content/camera/rain_pose.h"
#include "tests/app/navigation/test_flights.h"

namespace ergodome {
namespace {

using namespace test;  // NOLINT(google-build-using-namespace): flights of tests

//! Returns a show with a camera that falls, also sideways, through the horizon of a hole with spin
//! 0.9; the horizon is at 1.4359 M.
Show falling_through(double clock) {
  return parse_show("duration_s = 200\n[hole]\nspin = 0.9\n[camera.fall]\nclock = " + std::to_string(clock) +
                        "\nvelocity = { beta = 0.4, toward = [-1, 0.4, 0.7] }\nleast_r = 0.8\n[[camera.key]]\nr = 8\n"
                        "theta_deg = 70\n",
                    "through.toml");
}

//! Returns a navigator whose camera has followed the path of a show until a time of the show.
Navigator follower(const Show& show, double until_s) {
  Navigator navigator(show);
  for (double time_s = frame_s; time_s < until_s; time_s += frame_s) {
    navigator.advance(frame_s, {}, camera_pose(show, time_s));
  }
  navigator.advance(frame_s, {}, camera_pose(show, until_s));
  return navigator;
}

//! Returns the view relative to nonrotating directions, with axes boosted from the ZAMO frame.
glm::dquat view_of(const CameraPose& pose) { return placement_of(in_zamo_frame(pose, Spacetime{0.9})).view; }

TEST(FlightThroughHorizon, BeginsWithTheViewOfThePath) {
  const Show show = falling_through(0.5);
  Navigator navigator = follower(show, 12.0);
  const CameraPose path = camera_pose(show, 12.0);
  ASSERT_GT(angle_between(placement_of(path).view, view_of(path)), 0.05);
  navigator.leave_path();
  EXPECT_LT(angle_between(placement_of(navigator.pose()).view, view_of(path)), 1e-12);
  for (int i = 0; i < 30; ++i) {
    navigator.advance(frame_s, {}, path);
  }
  // The view rotates at most as fast as the axes of the path's camera.
  EXPECT_LT(angle_between(placement_of(navigator.pose()).view, view_of(path)), 0.05);
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
  double maximum = 0.0;
  while (navigator.course() != Navigator::Course::path && time_s < 60.0) {
    go_on({});
    const glm::dquat now = view_of(navigator.pose());
    maximum = std::max(maximum, angle_between(before, now));
    before = now;
  }
  ASSERT_EQ(navigator.course(), Navigator::Course::path);
  EXPECT_LT(maximum, 0.03);
}

//! Returns the smallest difference between the state of a flight and the points of a show's orbit:
//! the sum of differences in position (relative to r), velocity and view.
double off_the_orbit(const Show& show, const CameraPose& here) {
  double minimum = 1e9;
  for (double time_s = 0.0; time_s < 60.0; time_s += 0.002) {
    const CameraPose there = camera_pose(show, time_s);
    const Vector3<double> change = *there.velocity - *here.velocity;
    const double way = std::abs(there.r / here.r - 1.0) + std::sqrt(dot(change, change)) +
                       glm::distance(ingoing_placement(there, Spacetime{0.9}).towards,
                                     ingoing_placement(here, Spacetime{0.9}).towards);
    minimum = std::min(minimum,
                       way + 2.0 * std::acos(std::min(std::abs(glm::dot(there.orientation, here.orientation)), 1.0)));
  }
  return minimum;
}

TEST(FlightThroughHorizon, FallsOnAlongTheOrbitOfThePathFromWithinAndFromAbove) {
  const Show show = falling_through(0.3);
  const double horizon_s = *show.camera.orbit->horizon_s();
  for (const double after_s : {-4.0, -0.2, -0.005, 0.005, 0.3}) {
    SCOPED_TRACE(after_s);
    Navigator navigator = follower(show, horizon_s + after_s);
    navigator.next_mode();
    EXPECT_EQ(navigator.course(), Navigator::Course::free);
    EXPECT_NEAR(navigator.pose().r, camera_pose(show, horizon_s + after_s).r, 1e-12);
    const double at_first = glm::length(navigator.fly_velocity());
    EXPECT_GT(at_first, 0.05);
    for (int i = 0; i < 200; ++i) {
      navigator.advance(frame_s, {}, camera_pose(show, 0.0));
      EXPECT_TRUE(i > 5 || glm::length(navigator.fly_velocity()) > 0.8 * at_first) << i;
    }
    EXPECT_LT(off_the_orbit(show, navigator.pose()), 0.02);
  }
}

TEST(FlightThroughHorizon, FromWithinFallsOnWhereverSomebodySteers) {
  const Show show = falling_through(1.0);
  Navigator navigator = follower(show, *show.camera.orbit->horizon_s() + 0.2);
  const double r = navigator.pose().r;
  ASSERT_LT(r, horizon_radius(Spacetime{0.9}));
  navigator.leave_path();
  EXPECT_EQ(navigator.mode(), FlightMode::geodesic);
  navigator.advance(frame_s, {}, camera_pose(show, 0.0));
  EXPECT_LT(navigator.pose().r, r);
  EXPECT_GT(navigator.pose().r, 0.9 * r);
}

TEST(FlightThroughHorizon, FromWithinBeginsAtTheFirstKeyWhereTheShowSaysSo) {
  Show show = falling_through(1.0);
  show.flight.from = FlightStart::first_key;
  Navigator navigator = follower(show, *show.camera.orbit->horizon_s() + 0.5);
  ASSERT_LT(navigator.pose().r, horizon_radius(Spacetime{0.9}));
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
