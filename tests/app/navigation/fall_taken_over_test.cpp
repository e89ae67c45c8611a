#include <gtest/gtest.h>

#include <cmath>

#include "tests/app/navigation/test_flights.h"

namespace ergodome {
namespace {

using namespace test;  // NOLINT(google-build-using-namespace): flights of tests

Show falling_past_the_hole(const std::string& flight, int from_r = 12, int clock = 3) {
  const std::string start = "[[camera.key]]\nr = " + std::to_string(from_r) + "\ntheta_deg = 80\n";
  return parse_show("duration_s = 200\n[hole]\nspin = 0.9\n[camera]\n[camera.fall]\nclock = " + std::to_string(clock) +
                        "\nvelocity = { beta = 0.38, toward = [-0.3, 0.2, 1] }\n" + start + "[flight]\n" + flight,
                    "f.toml");
}

//! A camera that has followed the show's path for some time.
struct Follower {
  explicit Follower(const Show& show, double seconds = 10.0) : navigator(show) { follow(show, seconds); }

  void follow(const Show& show, double seconds, const Steering& steering = {}) {
    for (const double end_s = time_s + seconds; time_s < end_s - 1e-9;) {
      time_s += frame_s;
      navigator.advance(frame_s, holding(steering), camera_pose(show, time_s));
    }
  }

  Navigator navigator;
  double time_s = 0.0;
};

//! Returns the smallest difference between the state of a flight and the points of a show's orbit:
//! the sum of differences in position (relative to r) and in the observer's velocity.
double off_orbit(const Show& show, const Navigator& navigator) {
  const CameraPose here = navigator.pose();
  const Vector3<double> moves = navigator.flight_observer()->velocity;
  double minimum = 1e9;
  for (double time_s = 5.0; time_s < 100.0; time_s += 0.005) {
    const FallPosition there = show.camera.orbit->at(time_s);
    const CameraPlacement placement = placement_of({there.r, there.theta, there.phi, {1.0, 0.0, 0.0, 0.0}});
    const Vector3<double> change = there.velocity - moves;
    minimum = std::min(minimum, std::abs(there.r / here.r - 1.0) +
                                    glm::distance(placement.towards, placement_of(here).towards) +
                                    std::sqrt(dot(change, change)));
  }
  return minimum;
}

// Maximum difference from the nearest sample of the orbit: between samples, the camera moves by
// about 0.005 of its radius.
constexpr double between_tries = 0.01;

TEST(FallTakenOver, GoesOnAlongTheSameOrbit) {
  const Show show = falling_past_the_hole("mode = \"geodesic\"\n");
  Follower camera(show);
  camera.navigator.leave_path();
  for (int i = 0; i < 3; ++i) {
    camera.follow(show, 3.0);
    EXPECT_LT(off_orbit(show, camera.navigator), between_tries) << i;
  }
}

TEST(FallTakenOver, IsTheFirstWayToFlyFromAPathThatFalls) {
  const Show show = falling_past_the_hole("mode = \"orbit\"\n");
  Follower camera(show);
  camera.navigator.next_mode();
  EXPECT_EQ(camera.navigator.mode(), FlightMode::geodesic);
  camera.follow(show, 2.0);
  EXPECT_LT(off_orbit(show, camera.navigator), between_tries);
}

TEST(FallTakenOver, DoesNotStopOnTheWay) {
  const Show show = falling_past_the_hole("mode = \"geodesic\"\n");
  Follower camera(show);
  camera.navigator.leave_path();
  const double before = glm::length(camera.navigator.fly_velocity());
  ASSERT_GT(before, 0.1);
  for (int i = 0; i < 30; ++i) {
    camera.follow(show, frame_s);
    EXPECT_GT(glm::length(camera.navigator.fly_velocity()), 0.8 * before) << i;
  }
}

TEST(FallTakenOver, SlowsDownInComfortWhereTheShowWentFaster) {
  const Show show = falling_past_the_hole("mode = \"geodesic\"\n", 9, 8);
  for (const double seconds : {2.0, 4.0}) {
    SCOPED_TRACE(seconds);
    Follower camera(show, seconds);
    camera.navigator.leave_path();
    glm::dvec3 before = camera.navigator.fly_velocity();
    const double at_first = glm::length(before);
    for (int i = 0; i < 120; ++i) {
      camera.follow(show, frame_s);
      const glm::dvec3 now = camera.navigator.fly_velocity();
      EXPECT_LT(glm::length(now - before), 1.5 * show.flight.comfort.accel * frame_s) << i;
      before = now;
    }
    EXPECT_LT(glm::length(before), at_first - 0.1);
  }
}

TEST(FallTakenOver, IsForgottenByAFlightThatWentElsewhere) {
  const Show show = falling_past_the_hole("mode = \"orbit\"\n");
  Follower camera(show);
  camera.follow(show, 1.0);
  camera.navigator.leave_path();
  camera.follow(show, 3.0, {1.0});
  camera.navigator.set_mode(FlightMode::geodesic);
  camera.follow(show, 3.0);
  const CameraPose here = camera.navigator.pose();
  const Vector3<double> off =
      camera.navigator.flight_observer()->velocity - circular_velocity(spacetime_of(show), here.r, here.theta, 1.0);
  EXPECT_LT(std::sqrt(dot(off, off)), 0.1);
}

}  // namespace
}  // namespace ergodome
