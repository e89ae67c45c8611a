#include "kernels/spacetime/geodesic/timelike_orbit.h"

#include <gtest/gtest.h>

#include <cmath>
#include <utility>

#include "kernels/core/angles.h"
#include "kernels/spacetime/kerr/observer.h"

namespace ergodome {
namespace {

constexpr double tolerance = 1e-13;
constexpr int step_limit = 10'000'000;

double azimuth(const OrbitState& s) { return std::atan2(s.m.y, s.m.x) + s.drag; }

//! Returns by how much the constants of motion differ from their initial values, relative to their
//! size.
double drift(const OrbitConstants& now, const OrbitConstants& start) {
  return std::abs(now.energy - start.energy) +
         std::abs(now.axial_angular_momentum - start.axial_angular_momentum) / std::sqrt(start.polar_constant) +
         std::abs(now.polar_constant - start.polar_constant) / start.polar_constant;
}

void expect_constants_kept(double spin, double r, double theta, const Vector3<double>& velocity) {
  OrbitState orbit = make_orbit(Spacetime{spin}, r, theta, 0.3, velocity);
  const OrbitConstants start = orbit_constants(Spacetime{spin}, orbit);
  ASSERT_TRUE(advance_orbit(Spacetime{spin}, start, 1e4, tolerance, step_limit, orbit));
  EXPECT_LT(drift(orbit_constants(Spacetime{spin}, orbit), start), 1e-9)
      << "a " << spin << " r " << r << " theta " << theta;
  EXPECT_NEAR(dot(orbit.m, orbit.m), 1.0, 1e-9);
}

TEST(TimelikeOrbit, KeepsEnergyAngularMomentumAndCartersConstantForTenThousandM) {
  for (const double spin : {0.0, 0.5, 0.999, 1.0, -0.9}) {
    expect_constants_kept(spin, 14.0, pi / 2, {0.0, 0.0, 0.33});
    expect_constants_kept(spin, 14.0, 1.1, {0.05, 0.2, 0.27});
    expect_constants_kept(spin, 20.0, 0.4, {-0.02, -0.1, -0.24});
  }
}

TEST(TimelikeOrbit, KeepsItsConstantsOverTheAxis) { expect_constants_kept(0.9, 15.0, 0.2, {0.0, 0.28, 0.0}); }

TEST(TimelikeOrbit, KeepsItsConstantsVeryFarOut) { expect_constants_kept(0.9, 1e6, pi / 2, {0.0, 0.0, 1e-3}); }

//! Returns the angular velocity dφ/dt of a body, from the difference between two moments of its
//! orbit.
double angular_velocity(double spin, double r, ObserverMotion motion) {
  OrbitState orbit =
      make_orbit(Spacetime{spin}, r, pi / 2, 0.0, observer_velocity(motion, Spacetime{spin}, r, pi / 2, {}));
  EXPECT_TRUE(
      advance_orbit(Spacetime{spin}, orbit_constants(Spacetime{spin}, orbit), 1.0, tolerance, step_limit, orbit));
  EXPECT_NEAR(1.0 / orbit.u, r, 1e-10 * r);
  return azimuth(orbit) / orbit.time;
}

// Kepler's frequency: Bardeen, Press & Teukolsky (1972), eq. 2.16.
TEST(TimelikeOrbit, CircularOrbitsTurnAtKeplersFrequency) {
  for (const double spin : {0.0, 0.5, 0.999, 1.0, -0.9}) {
    for (const double r : {9.5, 30.0, 1e6}) {
      const double along = 1.0 / (std::pow(r, 1.5) + spin);
      const double against = -1.0 / (std::pow(r, 1.5) - spin);
      EXPECT_NEAR(angular_velocity(spin, r, ObserverMotion::geodesic) / along, 1.0, 1e-9) << spin << ' ' << r;
      EXPECT_NEAR(angular_velocity(spin, r, ObserverMotion::retrograde) / against, 1.0, 1e-9) << spin << ' ' << r;
    }
  }
}

//! Returns the radius, after 3,000 M of proper time, of a body that starts at radius r. Its speed
//! is that of a circular orbit, reduced by one part in 10,000.
double radius_of_slowed_orbit(double spin, double r) {
  const Vector3<double> circular = observer_velocity(ObserverMotion::geodesic, Spacetime{spin}, r, pi / 2, {});
  OrbitState orbit = make_orbit(Spacetime{spin}, r, pi / 2, 0.0, 0.9999 * circular);
  advance_orbit(Spacetime{spin}, orbit_constants(Spacetime{spin}, orbit), 3000.0, 1e-10, 100'000, orbit);
  return 1.0 / orbit.u;
}

TEST(TimelikeOrbit, CircularOrbitsAreStableOutsideTheInnermostStableOneAlone) {
  for (const double spin : {0.0, 0.9, -0.9}) {
    const double r = innermost_stable_radius(Spacetime{spin}, 1.0);
    EXPECT_NEAR(radius_of_slowed_orbit(spin, 1.15 * r), 1.15 * r, 0.1 * r) << spin;
    EXPECT_LT(radius_of_slowed_orbit(spin, 0.9 * r), 0.6 * r + 0.6) << spin;
  }
}

//! Returns the azimuth between two successive periapses. Finds the moments when the radial velocity
//! is 0 by bisection.
double periapsis_to_periapsis(double r, double speed) {
  OrbitState orbit = make_orbit(Spacetime{0.0}, r, pi / 2, 0.0, {0.0, 0.0, speed});
  const OrbitConstants constants = orbit_constants(Spacetime{0.0}, orbit);
  double turned = 0.0;
  double last = 0.0;
  bool fell = false;
  const auto step = [&](double duration) {
    EXPECT_TRUE(advance_orbit(Spacetime{0.0}, constants, duration, tolerance, step_limit, orbit));
    turned += std::remainder(azimuth(orbit) - last, 2.0 * pi);
    last = azimuth(orbit);
  };
  for (double h = 2.0; std::abs(h) > 1e-9;) {
    const OrbitState before = orbit;
    const double turned_before = turned;
    const double last_before = last;
    step(h);
    fell = fell || orbit.u_rate > 0.0;
    if (fell && orbit.u_rate <= 0.0) {
      orbit = before;
      turned = turned_before;
      last = last_before;
      h *= 0.5;
    }
  }
  return turned;
}

// Periapsis advance in Schwarzschild spacetime. From one periapsis to the next, the azimuth of an
// orbit between the radii p / (1 + e) and p / (1 - e) is 4 K(m) / √(1 - (6 - 2e) / p), with m = 4e
// / (p - 6 + 2e) (Cutler, Kennefick & Poisson 1994, eq. 2.23, as an elliptic integral).
TEST(TimelikeOrbit, PeriapsisAdvancesAsTheEllipticIntegralSays) {
  for (const auto& [p, e] : {std::pair(12.0, 0.2), std::pair(20.0, 0.5), std::pair(200.0, 0.1)}) {
    const double r = p / (1.0 + e);
    const double energy_square = ((p - 2.0) * (p - 2.0) - 4.0 * e * e) / (p * (p - 3.0 - e * e));
    const double gamma_lapse = std::sqrt(energy_square);
    const double lapse = std::sqrt(1.0 - 2.0 / r);
    const double gamma = gamma_lapse / lapse;
    const double speed = std::sqrt(1.0 - 1.0 / (gamma * gamma));
    const double modulus = std::sqrt(4.0 * e / (p - 6.0 + 2.0 * e));
    const double expected = 4.0 * std::comp_ellint_1(modulus) * std::sqrt(p / (p - 6.0 + 2.0 * e));
    EXPECT_NEAR(periapsis_to_periapsis(r, speed), expected, 1e-7) << "p " << p << " e " << e;
  }
}

TEST(TimelikeOrbit, ComesBackWhenTimeRunsBackwards) {
  OrbitState orbit = make_orbit(Spacetime{0.9}, 8.0, 1.2, 0.4, {0.1, 0.2, 0.3});
  const OrbitConstants constants = orbit_constants(Spacetime{0.9}, orbit);
  ASSERT_TRUE(advance_orbit(Spacetime{0.9}, constants, 300.0, tolerance, step_limit, orbit));
  ASSERT_TRUE(advance_orbit(Spacetime{0.9}, constants, -300.0, tolerance, step_limit, orbit));
  EXPECT_NEAR(1.0 / orbit.u, 8.0, 1e-8);
  EXPECT_NEAR(orbit.time, 0.0, 1e-7);
}

TEST(TimelikeOrbit, SaysWhenItCannotGoOnAtTheHorizon) {
  OrbitState orbit = make_orbit(Spacetime{0.9}, 3.0, pi / 2, 0.0, {-0.5, 0.0, 0.0});
  EXPECT_FALSE(advance_orbit(Spacetime{0.9}, orbit_constants(Spacetime{0.9}, orbit), 100.0, 1e-9, 2000, orbit));
  EXPECT_TRUE(std::isfinite(orbit.u) && std::isfinite(orbit.drag));
}

TEST(TimelikeOrbit, TellsTheVelocityThatItStartedWith) {
  const Vector3<double> velocity = {-0.1, 0.3, 0.5};
  const Vector3<double> reported = orbit_velocity(Spacetime{0.9}, make_orbit(Spacetime{0.9}, 2.5, 0.7, 2.0, velocity));
  EXPECT_NEAR(reported.x, velocity.x, 1e-14);
  EXPECT_NEAR(reported.y, velocity.y, 1e-14);
  EXPECT_NEAR(reported.z, velocity.z, 1e-14);
}

}  // namespace
}  // namespace ergodome
