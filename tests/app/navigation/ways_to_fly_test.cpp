#include <gtest/gtest.h>

#include <cmath>

#include "kernels/core/angles.h"
#include "kernels/spacetime/kerr/kerr.h"
#include "tests/app/navigation/test_flights.h"

namespace ergodome {
namespace {

using namespace test;  // NOLINT(google-build-using-namespace): flights of tests

TEST(Navigator, OrbitsOverThePoleWithoutALeapOfTheHoleInTheView) {
  Flier flier(show_at(0.9, 8.0, 40.0));
  Steering up;
  up.up = 1.0;
  flier.hold(up, 2.0);
  glm::dvec3 star = looks_at(flier.navigator);
  double phi = flier.navigator.pose().phi;
  double leap = 0.0;
  for (int i = 0; i < 240; ++i) {
    flier.hold(up, frame_s);
    const glm::dvec3 now = looks_at(flier.navigator);
    EXPECT_LT(glm::distance(now, star), 1.01 * pi / 3.0 * frame_s);
    EXPECT_GT(glm::dot(now, -placement_of(flier.navigator.pose()).towards), 0.99);
    leap = std::max(leap, std::abs(flier.navigator.pose().phi - phi));
    phi = flier.navigator.pose().phi;
    star = now;
  }
  EXPECT_NEAR(leap, pi, 1e-6);  // the flight passed over the pole
}

TEST(Navigator, GoesOnEastwardsAsTheScreenHasItOnBothSidesOfThePole) {
  Flier flier(show_at(0.0, 8.0, 10.0));
  Steering up;
  up.up = 1.0;
  flier.hold(up, 4.0);  // well beyond the pole
  Steering right;
  right.right = 1.0;
  flier.hold({}, 2.0);
  const CameraPlacement before = placement_of(flier.navigator.pose());
  flier.hold(right, 0.5);
  const glm::dvec3 way = placement_of(flier.navigator.pose()).towards - before.towards;
  EXPECT_GT(glm::dot(way, before.view * glm::dvec3(1.0, 0.0, 0.0)), 0.9 * glm::length(way));
}

TEST(Navigator, FarStarsKeepTheirPlaceInAShipThatPassesThePole) {
  Show show = show_at(0.9, 9.0, 5.0, "mode = \"fly\"\n");
  show.camera.keys[0].look = {LookTarget::Kind::direction, {0.0, -1.0, 0.0}};  // along the meridian
  Flier flier(show);
  const glm::dvec3 star = looks_at(flier.navigator);
  const glm::dquat local = flier.navigator.pose().orientation;
  flier.hold(forward_only(1.0), 3.0);
  EXPECT_LT(glm::distance(looks_at(flier.navigator), star), 1e-9);
  EXPECT_NEAR(std::abs(flier.navigator.pose().phi), pi, 1e-6);
  EXPECT_GT(angle_between(local, flier.navigator.pose().orientation), 3.0);  // the local frame has turned by about π
}

//! Returns the proper length between two camera positions in the space of zero-angular-momentum
//! observers, from the metric (Bardeen, Press & Teukolsky 1972, eq. 2.3).
double proper_length(double spin, const CameraPose& a, const CameraPose& b) {
  const double r = 0.5 * (a.r + b.r);
  const double theta = 0.5 * (a.theta + b.theta);
  const double sigma = r * r + spin * spin * std::cos(theta) * std::cos(theta);
  const double delta = r * r - 2.0 * r + spin * spin;
  const double sine2 = std::sin(theta) * std::sin(theta);
  const double around = (r * r + spin * spin + 2.0 * spin * spin * r * sine2 / sigma) * sine2;
  const double dr = b.r - a.r;
  const double dtheta = b.theta - a.theta;
  const double dphi = std::remainder(b.phi - a.phi, 2.0 * pi);
  return std::sqrt(sigma / delta * dr * dr + sigma * dtheta * dtheta + around * dphi * dphi);
}

TEST(Navigator, AShipsSpeedIsThatOfTheLocalSpace) {
  for (const double spin : {0.0, 0.9, 1.0}) {
    for (const Steering& way : {Steering{1.0, 0.0, 0.0}, Steering{0.0, 1.0, 0.0}, Steering{0.3, -0.7, -0.4}}) {
      Flier flier(show_at(spin, 3.0, 70.0, "mode = \"fly\"\n"));
      flier.hold(way, 2.0);
      const CameraPose before = flier.navigator.pose();
      const glm::dvec3 velocity = flier.navigator.fly_velocity();
      constexpr double moment_s = 1e-4;
      flier.navigator.advance(moment_s, holding(way), flier.path);
      const double expected = glm::length(velocity) * flier.navigator.space().distance(before.r) * moment_s;
      EXPECT_NEAR(proper_length(spin, before, flier.navigator.pose()) / expected, 1.0, 1e-3);
    }
  }
}

TEST(Navigator, HoveringStaysAndLooksAround) {
  Flier flier(show_at(0.9, 6.0, 70.0, "mode = \"hover\"\n"));
  const CameraPose before = flier.navigator.pose();
  flier.hold({1.0, 1.0, 1.0, 1.0}, 2.0);
  EXPECT_EQ(flier.navigator.pose().r, before.r);
  EXPECT_NEAR(flier.navigator.pose().theta, before.theta, 1e-12);
  EXPECT_GT(angle_between(flier.navigator.pose().orientation, before.orientation), 0.3);
  EXPECT_EQ(flier.navigator.flight_observer()->name, "static observer");
}

TEST(Navigator, RidesACircularOrbitOnceInFortySeconds) {
  Flier flier(show_at(0.9, 9.0, 90.0, "mode = \"geodesic\"\n"));
  flier.hold({}, 3.0);
  double turned = 0.0;
  double phi = flier.navigator.pose().phi;
  for (int i = 0; i < 600; ++i) {
    flier.hold({}, frame_s);
    turned += std::remainder(flier.navigator.pose().phi - phi, 2.0 * pi);
    phi = flier.navigator.pose().phi;
    ASSERT_NEAR(flier.navigator.pose().r, 9.0, 1e-7);
  }
  EXPECT_NEAR(turned, 0.5 * pi, 0.5);  // proper time runs slower than the clock of the stars
  const Vector3<double> v = flier.navigator.flight_observer()->velocity;
  const Vector3<double> circular = observer_velocity(ObserverMotion::geodesic, Spacetime{0.9}, 9.0, pi / 2, {});
  EXPECT_NEAR(v.z, circular.z, 1e-8);
}

TEST(Navigator, TheHoleStaysWhereItIsInTheViewOfAnInclinedOrbit) {
  Flier flier(show_at(0.9, 12.0, 40.0, "mode = \"geodesic\"\n"));
  flier.navigator.ride({0.0, 0.3, 0.05});
  double south = 0.0;
  for (int i = 0; i < 3000; ++i) {
    flier.hold({}, frame_s);
    ASSERT_GT(glm::dot(looks_at(flier.navigator), -placement_of(flier.navigator.pose()).towards), 0.999);
    south = std::max(south, flier.navigator.pose().theta);
  }
  EXPECT_GT(south, 2.2);
}

TEST(Navigator, AnOrbitThatFallsInComesToRestBeforeTheGuardAndSaysSo) {
  Flier flier(show_at(0.9, 4.0, 90.0, "mode = \"geodesic\"\nguard = \"photon_orbit\"\n"));
  flier.navigator.ride({-0.5, 0.0, 0.1});
  flier.hold({}, 40.0);
  EXPECT_GT(flier.navigator.pose().r, flier.navigator.space().guard_r());
  EXPECT_LT(flier.navigator.pose().r, 1.01 * flier.navigator.space().guard_r());
  EXPECT_NE(flier.navigator.flight_observer()->sentence.find("time is stopped"), std::string::npos);
}

}  // namespace
}  // namespace ergodome
