#include "content/camera/free_fall.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "content/camera/camera_path.h"
#include "content/show/animated_show.h"
#include "kernels/core/angles.h"

namespace ergodome {
namespace {

//! Settings of a fall whose clock runs at one M per second from the start on, so that the show time
//! is the camera's proper time.
FallSettings proper_time() {
  FallSettings settings;
  settings.clock = 1.0;
  settings.ease_s = 0.0;
  return settings;
}

FreeFall fall_of(double spin, const FallStart& start, double end_s) {
  return {Spacetime{spin}, start, proper_time(), nullptr, end_s};
}

FallStart observer_at(double spin, double r, ObserverMotion motion) {
  return {r, pi / 2, 0.0, observer_velocity(motion, Spacetime{spin}, r, pi / 2, {})};
}

struct FallCase {
  double spin;
  FallStart start;
};

//! Bound orbits that stay outside the horizon. Some cross the spin axis or pass near it; some go
//! with the hole's rotation, some against it.
std::vector<FallCase> bound_falls() {
  return {{0.0, {12.0, 1.2, 0.3, {0.05, 0.1, 0.28}}},  {0.9, {20.0, 1.22, -4.0, {0.0, 0.0, 0.13}}},
          {1.0, {14.0, 1.1, 0.0, {0.05, 0.2, 0.2}}},   {-1.0, {14.0, 1.1, 0.0, {0.0, 0.1, -0.3}}},
          {0.9, {15.0, 0.2, 1.0, {0.0, 0.28, 0.0}}},   {0.7, {12.0, 0.0, 2.0, {0.1, 0.3, 0.0}}},
          {0.9, {20.0, 1e-4, 0.0, {0.0, 0.24, 1e-6}}}, {0.998, {16.0, pi / 2, 0.0, {0.0, 0.0, -0.27}}}};
}

TEST(FreeFall, FromRestAtInfinityFollowsItsClosedForm) {
  const FreeFall fall = fall_of(0.0, observer_at(0.0, 20.0, ObserverMotion::rain), 39.0);
  for (int i = 0; i <= 100; ++i) {
    const double time_s = 0.39 * i;
    const double r = std::pow(std::pow(20.0, 1.5) - 1.5 * std::sqrt(2.0) * time_s, 2.0 / 3.0);
    const FallPosition position = fall.at(time_s);
    EXPECT_NEAR(position.r, r, 1e-10);
    EXPECT_NEAR(position.velocity.x, -std::sqrt(2.0 / r), 1e-11);
  }
}

TEST(FreeFall, MeetsTheHorizonWhenItsClosedFormDoes) {
  const FreeFall fall = fall_of(0.0, observer_at(0.0, 20.0, ObserverMotion::rain), 100.0);
  ASSERT_TRUE(fall.horizon_s().has_value());
  EXPECT_NEAR(*fall.horizon_s(), (std::pow(20.0, 1.5) - std::pow(2.0, 1.5)) / (1.5 * std::sqrt(2.0)), 2e-6);
}

// Bardeen, Press & Teukolsky (1972), eqs. 2.12 and 2.16: dφ/dτ = 1 / √(r³ - 3 r² ± 2 a r^(3/2)),
// with + for orbits that go with the hole's rotation and - for orbits that go against it.
TEST(FreeFall, StaysOnCircularOrbitsAndTurnsAtTheirRate) {
  for (const double spin : {0.0, 0.5, 0.998, 1.0, -0.9}) {
    for (const double sense : {1.0, -1.0}) {
      const double r = 10.0;
      const ObserverMotion motion = sense > 0.0 ? ObserverMotion::geodesic : ObserverMotion::retrograde;
      const FreeFall fall = fall_of(spin, observer_at(spin, r, motion), 1000.0);
      const double rate = sense / std::sqrt(r * r * (r - 3.0) + 2.0 * sense * spin * std::pow(r, 1.5));
      const FallPosition position = fall.at(1000.0);
      EXPECT_NEAR(position.r, r, 1e-8);
      EXPECT_NEAR(position.phi, 1000.0 * rate, 1e-8);
      EXPECT_NEAR(fall.swept_angle(1000.0), std::abs(1000.0 * rate), 1e-8);
      EXPECT_TRUE(fall.turns().empty());
    }
  }
}

// Periapsis advance of a slightly eccentric orbit around a hole without spin; the expected value is
// correct up to the square of the eccentricity.
TEST(FreeFall, AdvancesItsPeriapsisAsItShould) {
  const double e = 1e-4;
  for (const double p : {7.0, 12.0, 60.0}) {
    const double r = p / (1.0 - e);
    const double moment = p / std::sqrt(p - 3.0 - e * e);
    const double v = (moment / r) / std::sqrt(1.0 + moment * moment / (r * r));
    const FreeFall fall = fall_of(0.0, {r, pi / 2, 0.0, {0.0, 0.0, v}}, 60.0 * std::pow(p, 1.5));
    std::vector<double> nearest;
    for (const FallTurn& turn : fall.turns()) {
      if (turn.kind == FallTurn::Kind::nearest) {
        nearest.push_back(fall.at(turn.time_s).phi);
        EXPECT_NEAR(turn.r, p / (1.0 + e), 1e-8 * p);
      }
    }
    ASSERT_GE(nearest.size(), 3U);
    EXPECT_NEAR(nearest[2] - nearest[1], 2.0 * pi / std::sqrt(1.0 - 6.0 / p), 1e-4) << p;
  }
}

TEST(FreeFall, KeepsEnergyAngularMomentumAndCartersConstantForALongShow) {
  for (const FallCase& each : bound_falls()) {
    const FreeFall fall = fall_of(each.spin, each.start, 5000.0);
    const auto constants = [&](double time_s) {
      const FallPosition position = fall.at(time_s);
      return orbit_constants(Spacetime{each.spin}, make_orbit(Spacetime{each.spin}, position.r, position.theta,
                                                              position.phi, position.velocity));
    };
    const OrbitConstants begun = constants(0.0);
    for (int i = 1; i <= 50; ++i) {
      const OrbitConstants now = constants(5000.0 * i / 50.0);
      EXPECT_NEAR(now.energy, begun.energy, 1e-9);
      EXPECT_NEAR(now.axial_angular_momentum, begun.axial_angular_momentum, 1e-8);
      EXPECT_NEAR(now.polar_constant / begun.polar_constant, 1.0, 1e-9);
    }
  }
}

// The four-velocity of a body that a zero-angular-momentum observer sees with velocity v: u^r = γ
// v_r √(Δ/Σ), u^θ = γ v_θ / √Σ, u^φ = ω u^t + γ v_φ / (√(A/Σ) sinθ), with u^t = γ / α.
TEST(FreeFall, MovesAtItsVelocity) {
  for (const FallCase& each : bound_falls()) {
    const FreeFall fall = fall_of(each.spin, each.start, 400.0);
    for (const double time_s : {30.0, 111.0, 307.0}) {
      const double h = 1e-3;
      const FallPosition before = fall.at(time_s - h);
      const FallPosition after = fall.at(time_s + h);
      const FallPosition now = fall.at(time_s);
      const KerrFunctions f = kerr_functions(Spacetime{each.spin}, now.r, now.theta);
      const double gamma = 1.0 / std::sqrt(1.0 - dot(now.velocity, now.velocity));
      const double sine = std::sin(now.theta);
      const double dragged = f.frame_dragging * gamma / std::sqrt(f.sigma * f.delta / f.area);
      EXPECT_NEAR((after.r - before.r) / (2.0 * h), gamma * now.velocity.x * std::sqrt(f.delta / f.sigma), 1e-7);
      EXPECT_NEAR((after.theta - before.theta) / (2.0 * h), gamma * now.velocity.y / std::sqrt(f.sigma), 1e-6);
      EXPECT_NEAR(sine * (after.phi - before.phi) / (2.0 * h),
                  sine * dragged + gamma * now.velocity.z / f.circumference_factor, 1e-6);
    }
  }
}

TEST(FreeFall, IsTheSameWhoeverAsksAndHoweverLongItGoesOn) {
  const FallCase each = bound_falls()[1];
  const FreeFall fall = fall_of(each.spin, each.start, 300.0);
  const FreeFall longer = fall_of(each.spin, each.start, 900.0);
  std::vector<double> forwards;
  for (int i = 0; i <= 100; ++i) {
    forwards.push_back(fall.at(3.0 * i).r);
  }
  for (int i = 100; i >= 0; --i) {
    EXPECT_EQ(fall.at(3.0 * i).r, forwards[static_cast<std::size_t>(i)]);
    EXPECT_EQ(longer.at(3.0 * i).phi, fall.at(3.0 * i).phi);
  }
}

TEST(FreeFall, TakesTheViewAlongWithoutARollNorASeamAtTheAxis) {
  for (const FallCase& each : bound_falls()) {
    const FreeFall fall = fall_of(each.spin, each.start, 400.0);
    const auto in_space = [&](double time_s) {
      const FallPosition position = fall.at(time_s);
      return spherical_frame(position.theta, position.phi) * position.frame;
    };
    const double h = 0.05;
    for (double time_s = 0.0; time_s + h < 400.0; time_s += h) {
      const glm::dquat turn = in_space(time_s + h) * glm::inverse(in_space(time_s));
      const glm::dvec3 axis(turn.x, turn.y, turn.z);
      EXPECT_LT(glm::length(axis), 0.05);
      EXPECT_LT(std::abs(glm::dot(axis, in_space(time_s + 0.5 * h) * glm::dvec3(1.0, 0.0, 0.0))), 1e-6);
    }
  }
}

TEST(FreeFall, ComesToRestWhereItIsTold) {
  FallSettings settings = proper_time();
  settings.ease_s = 2.0;
  settings.least_r = 3.0;
  const FreeFall fall(Spacetime{0.0}, observer_at(0.0, 20.0, ObserverMotion::rain), settings, nullptr, 100.0);
  ASSERT_TRUE(fall.stop_s().has_value());
  EXPECT_FALSE(fall.horizon_s().has_value());
  EXPECT_NEAR(fall.at(*fall.stop_s()).r, 3.0, 1e-9);
  EXPECT_NEAR(fall.at(1e6).r, 3.0, 1e-9);
  EXPECT_GT(fall.at(*fall.stop_s() - 0.5).r, 3.01);
  EXPECT_NEAR(fall.at(100.0).velocity.x, -std::sqrt(2.0 / 3.0), 1e-9);
}

TEST(FreeFall, GoesOnForeverWhereItsOrbitLeadsOut) {
  const FreeFall fall = fall_of(0.9, {30.0, 1.0, 0.0, {-0.6, 0.0, 0.35}}, 1e5);
  EXPECT_FALSE(fall.horizon_s().has_value());
  EXPECT_GT(fall.at(1e5).r, 5e4);
  EXPECT_LT(fall.least_r(), 30.0);
}

TEST(FallClock, StartsFromRestAndThenRunsAsItIsTold) {
  FallSettings settings;
  settings.time_s = 4.0;
  settings.clock = 6.0;
  settings.ease_s = 2.0;
  const FallClock clock(settings, nullptr);
  EXPECT_EQ(clock.proper_time(3.0), 0.0);
  EXPECT_NEAR(clock.proper_time(6.0), 6.0, 1e-13);
  EXPECT_NEAR(clock.proper_time(16.0), 66.0, 1e-12);
  EXPECT_LT(clock.proper_time(4.01), 1e-6);
  EXPECT_NEAR(clock.time_s(66.0, 100.0).value(), 16.0, 1e-12);
  EXPECT_FALSE(clock.time_s(66.0, 15.0).has_value());
}

TEST(FallClock, IsTheIntegralOfItsNumber) {
  FallSettings settings;
  settings.time_s = 1.0;
  const Animation changing = {
      "camera.fall.clock",
      {{0.0, 8.0}, {3.0, 1.0, Ease::in_out}, {7.0, 5.0, Ease::hold}, {8.0, 2.0, Ease::linear}, {9.0, 0.0}}};
  const FallClock clock(settings, &changing);
  const auto rate = [&](double time_s) {
    return (clock.proper_time(time_s + 1e-4) - clock.proper_time(time_s - 1e-4)) / 2e-4;
  };
  EXPECT_NEAR(rate(2.5), value_at(changing, 2.5), 1e-6);
  EXPECT_NEAR(rate(5.0), value_at(changing, 5.0), 1e-6);
  EXPECT_NEAR(rate(7.5), 5.0, 1e-6);
  EXPECT_NEAR(rate(8.25), 1.5, 1e-6);
  EXPECT_NEAR(clock.proper_time(8.0) - clock.proper_time(3.0), 4.0 * 3.0 + 5.0, 1e-11);
  EXPECT_NEAR(clock.proper_time(100.0) - clock.proper_time(8.0), 1.0, 1e-12);
}

TEST(FallClock, StopsSmoothlyAndNeverRunsBack) {
  FallSettings settings;
  settings.clock = 5.0;
  FallClock clock(settings, nullptr);
  clock.stop_at(20.0);
  double before = 0.0;
  double rate_before = 0.0;
  for (int i = 1; i <= 1000; ++i) {
    const double now = clock.proper_time(0.01 * i);
    EXPECT_GE(now, before);
    EXPECT_LE(now, 20.0);
    EXPECT_NEAR(now - before, rate_before, 0.002);
    rate_before = now - before;
    before = now;
  }
  EXPECT_EQ(before, 20.0);
}

}  // namespace
}  // namespace ergodome
