#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "content/camera/rain_pose.h"
#include "content/camera/within.h"
#include "kernels/spacetime/kerr/camera_station.h"
#include "tests/app/navigation/test_flights.h"

namespace ergodome {
namespace {

using namespace test;  // NOLINT(google-build-using-namespace): flights of tests
using testing::HasSubstr;

//! A visitor who releases a camera at rest, so that it falls into the hole.
struct Visitor {
  explicit Visitor(const Show& show) : flier(show) { flier.navigator.let_go(); }

  void fall_until(const std::function<bool(const CameraPose&)>& there, const Steering& steering = {}) {
    for (int i = 0; i < 6000 && !there(pose()); ++i) {
      flier.hold(steering, frame_s);
    }
  }
  void fall_within(const Steering& steering = {}) {
    const double horizon = horizon_radius(flier.navigator.space().spacetime());
    fall_until([&](const CameraPose& here) { return here.r < 0.95 * horizon; }, steering);
  }
  [[nodiscard]] CameraPose pose() const { return flier.navigator.pose(); }

  Flier flier;
};

//! The constants of motion E, L and Q of a camera whose velocity is given in the rain frame.
struct Constants {
  double energy;
  double axial;
  double carter;
};

Constants constants_of(double spin, const CameraPose& pose) {
  const KerrFunctions f = kerr_functions(Spacetime{spin}, pose.r, pose.theta);
  const Vector3<double>& v = *pose.velocity;
  const double gamma = 1.0 / std::sqrt(1.0 - dot(v, v));
  const double sine = std::sin(pose.theta);
  const double axial = gamma * v.z * f.circumference_factor * sine;
  const double energy = gamma * (1.0 - f.rain_speed * v.x) + f.frame_dragging * axial;
  const double polar = gamma * v.y * std::sqrt(f.sigma);
  const double cosine = std::cos(pose.theta);
  // Carter's constant for mass 1 (Bardeen, Press & Teukolsky 1972, eq. 2.9).
  const double carter =
      polar * polar + cosine * cosine * (spin * spin * (1.0 - energy * energy) + axial * axial / (sine * sine));
  return {energy, axial, carter};
}

TEST(VisitorFallsIn, KeepsEnergyAngularMomentumAndCartersConstantToTheDeepestPlace) {
  for (const double spin : {0.0, 0.9, -0.6}) {
    Visitor visitor(show_at(spin, 5.0, 60.0));
    visitor.flier.hold({}, 0.1);
    const Constants first = constants_of(spin, visitor.pose());
    EXPECT_NEAR(first.axial, 0.0, 1e-9);
    visitor.fall_until([&](const CameraPose& here) {
      const Constants now = constants_of(spin, here);
      EXPECT_NEAR(now.energy, first.energy, 1e-8) << here.r;
      EXPECT_NEAR(now.axial, first.axial, 1e-8) << here.r;
      EXPECT_NEAR(now.carter, first.carter, 1e-8) << here.r;
      return here.r < 1.01 * deepest_rest(Spacetime{spin}) || testing::Test::HasFailure();
    });
    EXPECT_LT(visitor.pose().r, 1.01 * deepest_rest(Spacetime{spin}));
  }
}

TEST(VisitorFallsIn, ComesThroughTheHorizonFromFarAwayWithinTwoMinutes) {
  Visitor visitor(show_at(0.5, 3e4));
  visitor.flier.hold({}, 120.0);
  EXPECT_LT(visitor.pose().r, horizon_radius(Spacetime{0.5}));
}

TEST(VisitorFallsIn, ComesToRestAtTheDeepestPlaceAndSaysSo) {
  Visitor visitor(show_at(0.9, 4.0));
  Steering hurry;
  hurry.faster = 1.0;
  visitor.flier.hold(hurry, 80.0);
  EXPECT_GE(visitor.pose().r, deepest_rest(Spacetime{0.9}));
  EXPECT_LT(visitor.pose().r, 1.001 * deepest_rest(Spacetime{0.9}));
  EXPECT_FALSE(visitor.flier.navigator.moved());
  EXPECT_THAT(visitor.flier.navigator.flight_observer()->sentence,
              testing::AllOf(HasSubstr("inside the horizon"), HasSubstr("0.00 M of proper time left"),
                             HasSubstr("time is stopped")));
}

// Free fall from rest at r0 around a hole without spin: r = r0 (1 + cos η) / 2 at the proper time
// (r0³ / 8)^(1/2) (η + sin η), with the parameter η from 0 to π.
TEST(VisitorFallsIn, KnowsTheOwnTimeThatIsLeftByTheClosedForm) {
  constexpr double r0 = 4.0;
  CameraPose rests = camera_pose(show_at(0.0, r0), 0.0);
  rests.velocity = Vector3<double>{};
  const OrbitRide ride =
      OrbitRide::through_horizon(Spacetime{0.0}, FlightSettings(), in_rain_frame(rests, Spacetime{0.0}));
  const double eta = std::acos(2.0 * deepest_rest(Spacetime{0.0}) / r0 - 1.0);
  EXPECT_NEAR(ride.left().value(), std::sqrt(r0 * r0 * r0 / 8.0) * (eta + std::sin(eta)), 1e-5);
}

//! The energy, angular momentum and sky azimuth of the light that a camera sees in a direction of
//! its view. The azimuth is regular at the horizon.
struct Seen {
  double energy;
  double axial;
  glm::dvec3 placement;
};

Seen seen_by(double spin, const CameraPose& pose, const glm::dvec3& view) {
  const glm::dvec3 n = glm::normalize(pose.orientation * view);
  const ObserverMotion motion = pose.velocity_in_rain ? ObserverMotion::rain_boost : ObserverMotion::velocity;
  const CameraStation camera = make_camera_station(Spacetime{spin}, pose.r, pose.theta, 0.0, motion, *pose.velocity);
  const RayStart<double> ray = start_ray(camera, Vector3<double>{n.x, n.y, n.z});
  return {ray.energy, ray.axial_angular_momentum, ingoing_placement(pose, Spacetime{spin}).towards};
}

double apart(const Seen& a, const Seen& b) {
  return std::abs(a.energy / b.energy - 1.0) + std::abs(a.axial - b.axial) + glm::distance(a.placement, b.placement);
}

TEST(VisitorFallsIn, SeesTheSkyChangeAtTheHorizonAsLittleAsBesideIt) {
  constexpr double spin = 0.9;
  Visitor visitor(show_at(spin, 4.0, 70.0));
  const double horizon = horizon_radius(Spacetime{spin});
  visitor.fall_until([&](const CameraPose& here) { return here.r < 1.05 * horizon; });
  const glm::dvec3 views[] = {{0.3, 0.2, 1.0}, {-1.0, 0.4, 0.5}, {0.1, 1.0, 0.3}};
  double beside = 0.0;
  double across = 0.0;
  while (visitor.pose().r > 0.95 * horizon) {
    const CameraPose before = visitor.pose();
    visitor.flier.hold({}, frame_s);
    const CameraPose after = visitor.pose();
    double change = 0.0;
    for (const glm::dvec3& view : views) {
      change = std::max(change, apart(seen_by(spin, before, view), seen_by(spin, after, view)));
    }
    (before.r > horizon && after.r <= horizon ? across : beside) = std::max(beside, change);
  }
  ASSERT_GT(across, 0.0);
  EXPECT_LT(across, 1.1 * beside);
  EXPECT_LT(beside, 0.05);
}

TEST(VisitorFallsIn, BeginsWithTheSkyThatWhoMovesSoSawThere) {
  constexpr double spin = 0.9;
  const glm::dvec3 view(0.3, 0.2, 1.0);
  for (const Vector3<double>& velocity : {Vector3<double>{}, Vector3<double>{-0.5, 0.3, 0.2}}) {
    Flier flier(show_at(spin, 4.0, 70.0));
    flier.navigator.advance(1e-6, {}, flier.path);
    CameraPose moves = flier.navigator.pose();
    moves.velocity = velocity;
    flier.navigator.ride(velocity);
    flier.navigator.advance(1e-6, {}, flier.path);
    ASSERT_TRUE(flier.navigator.pose().velocity_in_rain);
    EXPECT_LT(apart(seen_by(spin, moves, view), seen_by(spin, flier.navigator.pose(), view)), 1e-5) << velocity.y;
  }
}

TEST(VisitorFallsIn, MovesAndTurnsWithinTheLimitsOfComfort) {
  const Show show = show_at(0.9, 6.0, 60.0);
  const FlightSpace space = FlightSpace::through_horizon(Spacetime{0.9}, show.flight);
  Visitor visitor(show);
  Steering hurry;
  hurry.faster = 1.0;
  hurry.yaw = 1.0;
  visitor.flier.hold(hurry, 0.1);
  glm::dvec3 fly = visitor.flier.navigator.fly_velocity();
  glm::dvec3 turn = visitor.flier.navigator.turn_rate();
  visitor.fall_until(
      [&](const CameraPose& before) {
        visitor.flier.hold(hurry, frame_s);
        const double speed = std::abs(visitor.pose().r - before.r) / frame_s / space.distance(before.r);
        EXPECT_LT(speed, 1.02 * show.flight.max_speed);
        EXPECT_LT(glm::length(visitor.flier.navigator.fly_velocity() - fly),
                  1.05 * show.flight.comfort.accel * frame_s);
        EXPECT_LT(glm::length(visitor.flier.navigator.turn_rate() - turn), 1.05 * 1.5708 * frame_s);
        fly = visitor.flier.navigator.fly_velocity();
        turn = visitor.flier.navigator.turn_rate();
        return before.r < 0.6 || testing::Test::HasFailure();
      },
      hurry);
  EXPECT_LT(visitor.pose().r, 0.7);
}

TEST(VisitorFallsIn, LooksAboutWithinTheHorizon) {
  Visitor visitor(show_at(0.6, 3.0));
  visitor.fall_within();
  const glm::dquat before = visitor.pose().orientation;
  Steering look;
  look.yaw = 1.0;
  visitor.flier.hold(look, 1.0);
  EXPECT_GT(angle_between(before, visitor.pose().orientation), 0.2);
}

TEST(VisitorFallsIn, IsNotBroughtOutByThrustNorByAnotherWayToFly) {
  Visitor visitor(show_at(0.6, 3.0));
  visitor.fall_within();
  double r = visitor.pose().r;
  for (int i = 0; i < 200; ++i) {
    visitor.flier.navigator.next_mode();
    visitor.flier.navigator.reverse_orbit();
    visitor.flier.navigator.ride({0.9, 0.0, 0.0});
    visitor.flier.hold(forward_only(-1.0), frame_s);
    ASSERT_LT(visitor.pose().r, r);
    r = visitor.pose().r;
  }
}

TEST(VisitorFallsIn, FliesOnWhereAnotherWayToFlyIsChosenAboveTheHorizon) {
  Visitor visitor(show_at(0.9, 4.0));
  visitor.fall_until([](const CameraPose& here) { return here.r < 1.7; });
  const CameraPose falls = in_zamo_frame(visitor.pose(), Spacetime{0.9});
  visitor.flier.navigator.next_mode();
  EXPECT_FALSE(visitor.pose().velocity_in_rain);
  EXPECT_LT(angle_between(placement_of(falls).view, placement_of(visitor.pose()).view), 1e-9);
  visitor.flier.hold(forward_only(-1.0), 10.0);
  EXPECT_GT(visitor.pose().r, 3.0);
}

TEST(VisitorFallsIn, ComesBackFromWithinAtOnce) {
  for (const bool to_path : {true, false}) {
    Visitor visitor(show_at(0.6, 3.0));
    visitor.fall_within();
    if (to_path) {
      visitor.flier.navigator.return_to_path();
    } else {
      visitor.flier.navigator.reset();
    }
    EXPECT_EQ(visitor.flier.navigator.course(), to_path ? Navigator::Course::path : Navigator::Course::free);
    visitor.flier.hold({}, 1.0);
    EXPECT_NEAR(visitor.pose().r, 3.0, 1e-9);
    EXPECT_FALSE(visitor.pose().velocity.has_value());
  }
}

TEST(VisitorFallsIn, FliesBackFromAboveTheHorizonWithoutALeap) {
  Visitor visitor(show_at(0.9, 4.0, 60.0));
  visitor.fall_until([](const CameraPose& here) { return here.r < 1.6; });
  const auto view = [&] { return placement_of(in_zamo_frame(visitor.pose(), Spacetime{0.9})); };
  CameraPlacement before = view();
  double clock_lead = visitor.pose().clock_lead;
  ASSERT_GT(clock_lead, 1.0);
  visitor.flier.navigator.return_to_path();
  for (int i = 0; i < 1800 && visitor.flier.navigator.course() != Navigator::Course::path; ++i) {
    visitor.flier.hold({}, frame_s);
    ASSERT_LT(angle_between(before.view, view().view), 0.05) << i;
    ASSERT_LT(std::abs(before.r - view().r), 0.1) << i;
    ASSERT_LT(std::abs(clock_lead - visitor.pose().clock_lead), 0.1) << i;
    before = view();
    clock_lead = visitor.pose().clock_lead;
  }
  EXPECT_NEAR(visitor.pose().r, 4.0, 1e-9);
  EXPECT_EQ(visitor.pose().clock_lead, 0.0);
}

TEST(VisitorFallsIn, SeesWhatStandsOutsideGoOnInTime) {
  constexpr double spin = 0.7;
  Visitor visitor(show_at(spin, 5.0, 60.0));
  visitor.flier.hold({}, frame_s);
  // A visitor sees the scene as it was when the light left it. Boyer-Lindquist time diverges at the
  // horizon, and so does the delay of the light; their difference must stay constant.
  const auto since_let_go = [&] { return visitor.pose().clock_lead - outer_lag(Spacetime{spin}, visitor.pose().r); };
  const double first = since_let_go();
  EXPECT_NEAR(visitor.pose().clock_lead, 0.0, 1e-3);
  visitor.fall_until([&](const CameraPose& here) {
    EXPECT_NEAR(since_let_go(), first, 1e-9) << here.r;
    return here.r < 1.2 || testing::Test::HasFailure();
  });
  EXPECT_LT(visitor.pose().r, 1.2);
}

TEST(VisitorFallsIn, StaysOutsideWhereTheShowKeepsVisitorsThere) {
  const struct {
    double spin;
    const char* flight;
    const char* says;
  } shows[] = {{0.0, "[[objects]]\nshape = \"sphere\"\nmethod = \"polygon\"\nsize = 0.5\nposition = [9, 0, 0]\n",
                "the objects of this show cannot be shown"},
               {0.9, "guard = \"photon_orbit\"\n", "leaves the flight region"},
               {1.0, "", "the inside of the hole cannot be shown"}};
  for (const auto& [spin, flight, says] : shows) {
    Visitor visitor(show_at(spin, 5.0, 90.0, flight));
    visitor.flier.hold({}, 60.0);
    EXPECT_GT(visitor.pose().r, visitor.flier.navigator.space().guard_r()) << says;
    EXPECT_THAT(visitor.flier.navigator.flight_observer()->sentence, HasSubstr(says));
  }
}

TEST(VisitorFallsIn, GoesOnWithinWhereTheShowsOwnEyesAreFlat) {
  Visitor visitor(show_at(0.9, 5.0, 90.0, "[stereo]\nmodel = \"flat\"\n"));
  visitor.fall_within();
  EXPECT_LT(visitor.pose().r, horizon_radius(Spacetime{0.9}));
}

TEST(VisitorFallsIn, OnceTooCloseOnlyEverDeeperWhateverIsAsked) {
  constexpr double spin = 0.7;
  Visitor visitor(show_at(spin, 2.5, 50.0, "max_speed = 2\n"));
  std::mt19937 random(11);
  bool went_in = false;
  for (int i = 0; i < 6000; ++i) {
    const bool committed = visitor.flier.navigator.committed();
    const double r = visitor.pose().r;
    if (random() % 20 == 0) {
      visitor.flier.navigator.let_go();
    } else if (random() % 200 == 0) {
      visitor.flier.navigator.next_mode();
    } else if (random() % 200 == 0) {
      visitor.flier.navigator.reverse_orbit();
    }
    constexpr double times_s[] = {0.0, 1e-9, 1.0 / 60, 0.1, 5.0, -1.0, NAN};
    visitor.flier.navigator.advance(times_s[random() % 7], {wild(random), wild(random)}, visitor.flier.path);
    const CameraPose now = visitor.pose();
    ASSERT_TRUE(std::isfinite(now.r + now.theta + now.phi) && now.r >= deepest_rest(Spacetime{spin})) << i;
    ASSERT_NEAR(glm::length(now.orientation), 1.0, 1e-9) << i;
    ASSERT_TRUE(!now.velocity || dot(*now.velocity, *now.velocity) < 1.0) << i;
    ASSERT_TRUE(!committed || now.r <= r) << i;
    went_in = went_in || committed;
    if (committed && random() % 500 == 0) {
      visitor.flier.navigator.reset();
    }
  }
  EXPECT_TRUE(went_in);
}

}  // namespace
}  // namespace ergodome
