#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "content/camera/camera_path.h"
#include "content/camera/free_fall.h"
#include "content/camera/rain_pose.h"
#include "content/show/reading/show_reader.h"
#include "kernels/core/angles.h"
#include "kernels/spacetime/kerr/camera_station.h"
#include "tests/support/errors.h"

namespace ergodome {
namespace {

using testing::AllOf;
using testing::HasSubstr;

//! Returns a free fall through the horizon down to r = `least_r`. The show time is the camera's
//! proper time.
FreeFall fall_through(double spin, const FallStart& start, double least_r, double end_s) {
  FallSettings settings;
  settings.clock = 1.0;
  settings.ease_s = 0.0;
  settings.least_r = least_r;
  return {Spacetime{spin}, start, settings, nullptr, end_s};
}

FallStart rain_at(double spin, double r, double theta) {
  return {r, theta, 0.4, observer_velocity(ObserverMotion::rain, Spacetime{spin}, r, theta, {})};
}

//! Returns the proper time of a fall from r = 20 to a smaller radius around a hole without spin,
//! for an observer of the rain frame.
double rain_time(double r) { return (std::pow(20.0, 1.5) - std::pow(r, 1.5)) / (1.5 * std::sqrt(2.0)); }

TEST(FallWithin, RainAboutAHoleWithoutSpinFallsAsItsClosedFormThroughTheHorizon) {
  const FreeFall fall = fall_through(0.0, rain_at(0.0, 20.0, 1.1), 0.05, 80.0);
  EXPECT_NEAR(fall.horizon_s().value_or(0.0), rain_time(2.0), 1e-9);
  for (const double r : {10.0, 2.001, 1.999, 1.0, 0.3, 0.06}) {
    const FallPosition position = fall.at(rain_time(r));
    EXPECT_NEAR(position.r, r, 1e-9) << r;
    EXPECT_LT(dot(position.velocity, position.velocity), 1e-18) << r;
  }
}

//! Returns the azimuth that an observer of the rain frame covers from infinity to r, in ingoing
//! Kerr coordinates: ∫ a dr / ((r² + a²)(1 + √(2r / (r² + a²)))), by Simpson's rule in 1/√r.
double rain_turn_to(double spin, double r) {
  const auto rate = [&](double w) {
    const double at = 1.0 / (w * w);
    const double square = at * at + spin * spin;
    return spin / (square * (1.0 + std::sqrt(2.0 * at / square))) * 2.0 * at / w;
  };
  constexpr int steps = 4000;
  const double h = 1.0 / std::sqrt(r) / steps;
  double sum = rate(h * steps);
  for (int i = 1; i < steps; ++i) {
    sum += (i % 2 == 1 ? 4.0 : 2.0) * rate(h * i);
  }
  return -sum * h / 3.0;
}

TEST(FallWithin, RainKeepsDoransAzimuth) {
  for (const double spin : {0.5, -0.9}) {
    const FreeFall fall = fall_through(spin, rain_at(spin, 20.0, 1.1), 0.9, 80.0);
    const double doran = 0.4 + ingoing_turn(Spacetime{spin}, 20.0) - rain_turn_to(spin, 20.0);
    for (const double time_s : {30.0, 38.0, *fall.horizon_s() + 0.1}) {
      const FallPosition position = fall.at(time_s);
      const double turn =
          position.r > horizon_radius(Spacetime{spin}) ? ingoing_turn(Spacetime{spin}, position.r) : 0.0;
      EXPECT_NEAR(position.phi + turn - rain_turn_to(spin, position.r), doran, 1e-8) << spin << ' ' << time_s;
      EXPECT_NEAR(position.theta, 1.1, 1e-10);
    }
  }
}

//! Returns the energy E and the angular momentum L of a body whose velocity is given in the rain
//! frame.
std::pair<double, double> constants_of(double spin, const FallPosition& position) {
  const KerrFunctions f = kerr_functions(Spacetime{spin}, position.r, position.theta);
  const double gamma = 1.0 / std::sqrt(1.0 - dot(position.velocity, position.velocity));
  const double axial = gamma * position.velocity.z * f.circumference_factor * std::sin(position.theta);
  return {gamma * (1.0 - f.rain_speed * position.velocity.x) + f.frame_dragging * axial, axial};
}

TEST(FallWithin, EnergyAndAngularMomentumStayThroughTheHorizon) {
  const FallStart start = {9.0, 1.2, -0.3, {-0.35, 0.1, 0.12}};
  for (const double spin : {0.0, 0.9, -0.7}) {
    const FreeFall fall = fall_through(spin, start, 0.8, 40.0);
    ASSERT_TRUE(fall.stop_s().has_value()) << spin;
    const auto [energy, axial] = constants_of(spin, fall.at(0.0));
    for (int i = 1; i <= 20; ++i) {
      const auto now = constants_of(spin, fall.at(*fall.stop_s() * i / 20.0));
      EXPECT_NEAR(now.first, energy, 1e-10) << spin << ' ' << i;
      EXPECT_NEAR(now.second, axial, 1e-10) << spin << ' ' << i;
    }
  }
}

const std::string through_the_horizon =
    "duration_s = 60\n[hole]\nspin = 0.9\n[[camera.key]]\nr = 12\ntheta_deg = 70\n[camera.fall]\n"
    "velocity = { beta = 0.3, toward = [-3, 1, 1] }\nclock = 2\n";

Show show_through(const std::string& more = "") {
  return parse_show(through_the_horizon + "least_r = 0.8\n" + more, "t.toml");
}

//! Returns the angle of the rotation between the orientations of two poses.
double turn_between(const CameraPose& a, const CameraPose& b) {
  return 2.0 * std::acos(std::min(std::abs(glm::dot(a.orientation, b.orientation)), 1.0));
}

TEST(FallWithin, ViewAndVelocityDoNotLeapAtItsBeginningNorAtTheHorizon) {
  const Show show = show_through();
  const double horizon_s = *show.camera.orbit->horizon_s();
  const CameraPose begins = in_zamo_frame(camera_pose(show, 1e-6), spacetime_of(show));
  EXPECT_LT(turn_between(begins, camera_pose(show, -1e-6)), 1e-6);
  const CameraPose before = camera_pose(show, horizon_s - 1e-7);
  const CameraPose after = camera_pose(show, horizon_s + 1e-7);
  EXPECT_GT(before.r, horizon_radius(Spacetime{0.9}));
  EXPECT_LT(after.r, horizon_radius(Spacetime{0.9}));
  EXPECT_LT(turn_between(before, after), 1e-5);
  const Vector3<double> change = *after.velocity - *before.velocity;
  EXPECT_LT(dot(change, change), 1e-10);
}

TEST(FallWithin, KeepsItsDirectionsWhereItIsTakenToTheZamosFrame) {
  const Show show = show_through();
  const CameraPose falls = camera_pose(show, 3.0);
  const CameraPose same = in_zamo_frame(falls, spacetime_of(show));
  ASSERT_TRUE(falls.velocity_in_rain);
  EXPECT_FALSE(same.velocity_in_rain);
  // Whether the velocity is given in the rain frame or the ZAMO frame, light from the same view
  // direction must have the same energy and angular momentum.
  const auto light_in = [&](const CameraPose& pose, ObserverMotion motion, const glm::dvec3& seen) {
    const glm::dvec3 n = glm::normalize(pose.orientation * seen);
    const CameraStation camera =
        make_camera_station(spacetime_of(show), pose.r, pose.theta, 0.0, motion, *pose.velocity);
    return start_ray(camera, Vector3<double>{n.x, n.y, n.z});
  };
  for (const glm::dvec3& seen : {glm::dvec3(0.3, 0.2, -1.0), glm::dvec3(-1.0, 0.1, 0.3), glm::dvec3(0.1, 1.0, 0.5)}) {
    const RayStart<double> rain = light_in(falls, ObserverMotion::rain_boost, seen);
    const RayStart<double> zamo = light_in(same, ObserverMotion::velocity, seen);
    EXPECT_NEAR(rain.energy, zamo.energy, 1e-12);
    EXPECT_NEAR(rain.axial_angular_momentum, zamo.axial_angular_momentum, 1e-11);
    EXPECT_NEAR(rain.polar_constant, zamo.polar_constant, 1e-10);
  }
}

TEST(FallWithin, IsAFallLikeAnyOtherWhereTheHorizonIsNotReached) {
  const std::string circles =
      "duration_s = 60\n[hole]\nspin = 0.9\n[[camera.key]]\nr = 12\n[camera.fall]\nvelocity = \"geodesic\"\nclock = "
      "2\n";
  const Show meant = parse_show(circles + "least_r = 0.8\n[disk]\n", "meant.toml");
  const Show plain = parse_show(circles, "plain.toml");
  EXPECT_FALSE(leads_within(meant));
  EXPECT_FALSE(camera_pose(meant, 30.0).velocity_in_rain);
  EXPECT_EQ(camera_pose(meant, 30.0).phi, camera_pose(plain, 30.0).phi);
}

TEST(FallWithin, ComesToRestAtItsLeastRadius) {
  const Show show = show_through();
  EXPECT_NEAR(camera_pose(show, 60.0).r, 0.8, 1e-9);
  EXPECT_LT(*show.camera.orbit->stop_s(), 60.0);
}

std::string error_of(const std::string& text) {
  return test::error_of([&] { parse_show(text, "t.toml"); });
}

TEST(FallWithin, RefusesWhatCannotBeSeenFromThere) {
  EXPECT_THAT(error_of(through_the_horizon + "least_r = 0.8\n[stereo]\nmodel = \"flat\"\n"),
              AllOf(HasSubstr("t.toml:10: camera.fall.least_r leads through the horizon"), HasSubstr("flat")));
  const std::string without_spin =
      "duration_s = 60\n[[camera.key]]\nr = 12\n[camera.fall]\nclock = 2\nvelocity = \"rain\"\nleast_r = 0.9\n";
  EXPECT_THAT(error_of(without_spin + "[[objects]]\nshape = \"sphere\"\nposition = [9, 0, 0]\nmethod = \"polygon\"\n"),
              HasSubstr("polygon"));
}

TEST(FallWithin, RefusesRadiiAtTheHorizonAndTooNearToTheInnerOne) {
  for (const char* const r : {"0.58", "1.435", "1.437", "12"}) {
    EXPECT_THAT(error_of(through_the_horizon + "least_r = " + r + "\n"),
                AllOf(HasSubstr("t.toml:10: camera.fall.least_r is "), HasSubstr("inside the horizon 0.5")))
        << r;
  }
}

TEST(FallWithin, RefusesAnEndFromWhichKeysWouldLeadOut) {
  EXPECT_THAT(error_of(through_the_horizon + "least_r = 0.8\nuntil_s = 40\n"),
              HasSubstr("t.toml:11: camera.fall.until_s cannot end the fall, because least_r is inside the horizon"));
}

TEST(FallWithin, AHoleThatSpinsAtItsMostHasNoInside) {
  const std::string extremal = "duration_s = 60\n[hole]\nspin = 1\n[[camera.key]]\nr = 12\n[camera.fall]\nclock = 2\n";
  EXPECT_THAT(error_of(extremal + "velocity = \"rain\"\nleast_r = 0.9\n"),
              AllOf(HasSubstr("camera.fall.least_r is 0.9"), testing::Not(HasSubstr("inside the horizon"))));
}

}  // namespace
}  // namespace ergodome
