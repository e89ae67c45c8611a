#include "kernels/spacetime/geodesic/rain_orbit.h"

#include <gtest/gtest.h>

#include <cmath>

namespace ergodome {
namespace {

struct Passage {
  double spin;
  double r;
  double theta;
  Vector3<double> velocity;
};

constexpr Passage passages[] = {{0.0, 1.2, 1.0, {-0.3, 0.4, 0.2}},
                                {0.9, 1.0, 0.4, {0.2, -0.5, 0.6}},
                                {-0.7, 6.0, 2.0, {-0.1, 0.3, -0.4}},
                                {0.6, 1.8, 1.57, {0.0, 0.0, 0.0}}};

TEST(RainOrbit, HasTheVelocityThatItWasMadeWith) {
  for (const Passage& p : passages) {
    const RainOrbit orbit = make_rain_orbit(Spacetime{p.spin}, p.r, p.theta, 0.8, p.velocity);
    const Vector3<double> off = orbit_rain_velocity(Spacetime{p.spin}, orbit.constants, orbit.state, 0.8) - p.velocity;
    EXPECT_LT(dot(off, off), 1e-26) << p.spin;
  }
}

TEST(RainOrbit, HasTheConstantsOfTheSameBodyInTheZamosFrame) {
  const Passage& p = passages[2];
  const Vector3<double> in_zamo =
      observer_velocity(ObserverMotion::rain_boost, Spacetime{p.spin}, p.r, p.theta, p.velocity);
  const OrbitConstants expected =
      orbit_constants(Spacetime{p.spin}, make_orbit(Spacetime{p.spin}, p.r, p.theta, 0.8, in_zamo));
  const OrbitConstants found = make_rain_orbit(Spacetime{p.spin}, p.r, p.theta, 0.8, p.velocity).constants;
  EXPECT_NEAR(found.energy, expected.energy, 1e-13);
  EXPECT_NEAR(found.axial_angular_momentum, expected.axial_angular_momentum, 1e-12);
  EXPECT_NEAR(found.polar_constant, expected.polar_constant, 1e-11);
}

//! Returns whether a body falls into a hole without spin. It starts in the equatorial plane at r,
//! with zero radial velocity and angular momentum L = `axial` [M].
bool comes_in(double r, double axial) {
  const double across = axial / std::sqrt(axial * axial + r * r);
  const OrbitState s = make_orbit(Spacetime{0.0}, r, 1.5707963267948966, 0.0, {0.0, 0.0, across});
  return falls_in(Spacetime{0.0}, orbit_constants(Spacetime{0.0}, s), s);
}

// Around a hole without spin, the potential barrier of a bound body vanishes if L < √12 M. For
// larger L, it is at r = (L² - L √(L² - 12)) / 2 < 6 M.
TEST(RainOrbit, FallsInWhereTheBarrierOfItsAngularMomentumDoesNotHoldIt) {
  EXPECT_TRUE(comes_in(20.0, 3.4));
  EXPECT_FALSE(comes_in(20.0, 3.9));
  const double barrier = 0.5 * (3.8 * 3.8 - 3.8 * std::sqrt(3.8 * 3.8 - 12.0));
  EXPECT_TRUE(comes_in(0.99 * barrier, 3.8));
  EXPECT_FALSE(comes_in(1.01 * barrier, 3.8));
}

TEST(RainOrbit, DoesNotFallInWhereItGoesOutForGood) {
  const OrbitState out = make_orbit(Spacetime{0.5}, 8.0, 1.0, 0.0, {0.9, 0.0, 0.1});
  EXPECT_FALSE(falls_in(Spacetime{0.5}, orbit_constants(Spacetime{0.5}, out), out));
}

}  // namespace
}  // namespace ergodome
