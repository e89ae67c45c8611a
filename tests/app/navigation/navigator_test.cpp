#include "app/navigation/navigator.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <string>

#include "kernels/core/angles.h"
#include "kernels/spacetime/kerr/kerr.h"
#include "tests/app/navigation/test_flights.h"

namespace ergodome {
namespace {

using namespace test;  // NOLINT(google-build-using-namespace): flights of tests

TEST(FlightSpace, GuardsAreOutsideTheHorizonAndOutsideEveryOrbitOfLight) {
  FlightSettings settings;
  EXPECT_NEAR(guard_radius(Spacetime{0.0}, settings), 2.02, 1e-12);
  settings.guard = FlightGuard::photon_orbit;
  EXPECT_NEAR(guard_radius(Spacetime{1.0}, settings), 4.04, 1e-12);   // retrograde light orbits at 4
  EXPECT_NEAR(guard_radius(Spacetime{-1.0}, settings), 4.04, 1e-12);  // and if the hole rotates oppositely
  settings.least_r = 7.0;
  EXPECT_EQ(guard_radius(Spacetime{0.0}, settings), 7.0);
}

void play_wildly(Navigator& navigator, std::mt19937& random, const CameraPose& path) {
  constexpr double times_s[] = {0.0, 1e-9, 1.0 / 240, 1.0 / 60, 0.1, 5.0, -1.0, 1e300, NAN};
  switch (random() % 40) {
    case 0:
      navigator.next_mode();
      break;
    case 1:
      navigator.return_to_path();
      break;
    case 2:
      navigator.leave_path();
      break;
    case 3:
      navigator.reverse_orbit();
      break;
    default:
      break;
  }
  const Steering rates = random() % 3 == 0 ? forward_only(1.0) : wild(random);
  navigator.advance(times_s[random() % 9], {rates, random() % 5 == 0 ? wild(random) : Steering{}}, path);
}

TEST(Navigator, NeverComesWithinItsGuardWhateverIsAskedAndHoweverLongAFrameTakes) {
  constexpr int inputs = 10'000;
  for (const double spin : {0.0, 0.5, 0.999, 1.0, -0.9}) {
    for (const char* guard : {"horizon", "photon_orbit"}) {
      // The spin is animated. Such a show does not allow falls through the horizon, so that the
      // guard (the surface outside which a visitor's camera stays) applies.
      std::string numbers = "guard = \"" + std::string(guard) + "\"\nmax_speed = 3\nmost_r = 50\n";
      numbers += "[[animate]]\nnumber = \"hole.spin\"\nkey = [";
      for (const char* time : {"{ t_s = 0", ", { t_s = 1"}) {
        numbers.append(time).append(", value = ").append(std::to_string(spin)).append(" }");
      }
      const Show show = show_at(spin, 6.0, 50.0, numbers + "]\n");
      Navigator navigator(show);
      navigator.leave_path();
      std::mt19937 random(7);
      const CameraPose path = camera_pose(show, 0.0);
      double nearest = 100.0;
      for (int i = 0; i < inputs; ++i) {
        play_wildly(navigator, random, path);
        const CameraPose pose = navigator.pose();
        ASSERT_TRUE(pose.r > guard_radius(Spacetime{spin}, show.flight) && pose.r <= 50.0 * (1.0 + 1e-9))
            << pose.r << " at " << i;
        ASSERT_TRUE(std::isfinite(pose.theta + pose.phi)) << i;
        ASSERT_NEAR(glm::length(pose.orientation), 1.0, 1e-9) << i;
        nearest = std::min(nearest, pose.r);
      }
      EXPECT_LT(nearest, 1.5 * guard_radius(Spacetime{spin}, show.flight)) << "the guard was never tried";
    }
  }
}

TEST(Navigator, NearsTheGuardSmoothlyAndLeavesItAgain) {
  Flier flier(show_at(0.9, 6.0));
  const double guard = flier.navigator.space().guard_r();
  double height = 6.0 - guard;
  for (int i = 0; i < 3000; ++i) {
    flier.hold(forward_only(1.0), frame_s);
    const double now = flier.navigator.pose().r - guard;
    ASSERT_LE(now, height) << "went back by itself in frame " << i;
    height = now;
  }
  EXPECT_LT(height, 1e-4);
  flier.hold(forward_only(-1.0), 20.0);
  EXPECT_GT(flier.navigator.pose().r, 10.0);
}

TEST(Navigator, NearsTheFarLimitSmoothlyToo) {
  Flier flier(show_at(0.9, 6.0, 90.0, "most_r = 40\n"));
  flier.hold(forward_only(-1.0), 60.0);
  EXPECT_NEAR(flier.navigator.pose().r, 40.0, 1e-6);
  EXPECT_LE(flier.navigator.pose().r, 40.0);
}

TEST(Navigator, FliesAMillionMOut) {
  Flier flier(show_at(0.9, 1e6, 90.0, "most_r = 1e8\nmode = \"fly\"\n"));
  flier.hold(forward_only(1.0), 60.0);
  EXPECT_LT(flier.navigator.pose().r, 10.0);  // the speed is proportional to the distance
  flier.hold(forward_only(-1.0), 60.0);
  EXPECT_TRUE(std::isfinite(flier.navigator.pose().r));
}

TEST(Navigator, BringsACameraOutThatThePathHadLedIn) {
  Flier flier(show_at(0.9, 2.5, 90.0, "guard = \"photon_orbit\"\n"));
  double r = 2.5;
  for (int i = 0; i < 600; ++i) {
    flier.hold(forward_only(1.0), frame_s);
    ASSERT_LT(flier.navigator.pose().r - r, 0.1);
    ASSERT_GE(flier.navigator.pose().r, r - 0.01);
    r = flier.navigator.pose().r;
  }
  EXPECT_GE(r, flier.navigator.space().guard_r());
}

TEST(Navigator, StartsFromTheFirstKeyWhereTheShowSaysSo) {
  Show show = moving_show();
  show.flight.from = FlightStart::first_key;
  Navigator navigator(show);
  navigator.advance(frame_s, {}, camera_pose(show, 50.0));
  navigator.leave_path();
  EXPECT_NEAR(navigator.pose().r, 12.0, 1e-12);
}

TEST(Navigator, ResetGoesToTheStartAtRest) {
  Flier flier(show_at(0.9, 8.0));
  flier.hold({1.0, 1.0, 1.0, 1.0}, 3.0);
  flier.navigator.reset();
  flier.hold({}, 1.0);
  EXPECT_NEAR(flier.navigator.pose().r, 8.0, 1e-12);
  EXPECT_NEAR(flier.navigator.pose().phi, 0.0, 1e-12);
}

TEST(Navigator, AMouseTurnsTheViewByTheAngleItWasMoved) {
  Flier flier(show_at(0.9, 8.0, 90.0, "mode = \"fly\"\n"));
  SteeringInput drag;
  drag.amounts.yaw = 0.3;
  const glm::dquat before = placement_of(flier.navigator.pose()).view;
  flier.navigator.advance(frame_s, drag, flier.path);
  flier.hold({}, 4.0);
  EXPECT_NEAR(angle_between(before, placement_of(flier.navigator.pose()).view), 0.3, 1e-3);
  EXPECT_GT(glm::dot(looks_at(flier.navigator), before * glm::dvec3(1.0, 0.0, 0.0)), 0.2);  // looks to the right
}

TEST(Navigator, StaysOutsideAHoleWhoseHorizonGrows) {
  Flier flier(show_at(1.0, 3.0));
  flier.hold(forward_only(1.0), 30.0);
  EXPECT_LT(flier.navigator.pose().r, 1.1);
  flier.navigator.set_spacetime(Spacetime{0.0});
  flier.hold(forward_only(1.0), 1.0);
  EXPECT_GT(flier.navigator.pose().r, 2.0);
}

TEST(Navigator, SaysWhenNothingMoves) {
  Flier flier(show_at(0.9, 8.0));
  flier.hold({1.0}, 0.5);
  EXPECT_TRUE(flier.navigator.moved());
  flier.hold({}, 5.0);
  EXPECT_FALSE(flier.navigator.moved());
}

}  // namespace
}  // namespace ergodome
