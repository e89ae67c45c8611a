#include "kernels/spacetime/spacetime.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <type_traits>

#include "kernels/core/angles.h"
#include "kernels/spacetime/geodesic/radial_potential.h"
#include "tests/kernels/reference_tables.h"

// Radii against the equations that they solve, and their values for holes without spin and of
// maximum spin (Bardeen, Press & Teukolsky 1972, section II).
namespace ergodome {
namespace {

constexpr double spacetime_spins[] = {-1.0, -0.998, -0.5, 0.0, 0.01, 0.3, 0.9, 0.999999, 1.0};

static_assert(std::is_trivially_copyable_v<Spacetime> && sizeof(Spacetime) == sizeof(double));
static_assert(!std::is_convertible_v<double, Spacetime>, "a number alone does not define a spacetime");

TEST(Spacetime, HorizonsAreTheRootsOfDelta) {
  for (const double spin : spacetime_spins) {
    const Spacetime spacetime{spin};
    const double outer = horizon_radius(spacetime);
    const double inner = inner_horizon_radius(spacetime);
    EXPECT_NEAR(outer + inner, 2.0, 1e-15) << spin;
    EXPECT_NEAR(outer * inner, spin * spin, 1e-15) << spin;
    EXPECT_GE(outer, inner) << spin;
    EXPECT_LE(inner, min_interior_radius(spacetime)) << spin;
    EXPECT_LE(min_interior_radius(spacetime), outer) << spin;
  }
}

TEST(Spacetime, HorizonOfExtremalHoleIsAtOneAndOfSchwarzschildAtTwo) {
  EXPECT_DOUBLE_EQ(horizon_radius(Spacetime{1.0}), 1.0);
  EXPECT_DOUBLE_EQ(horizon_radius(Spacetime{-1.0}), 1.0);
  EXPECT_DOUBLE_EQ(horizon_radius(Spacetime{}), 2.0);
}

TEST(Spacetime, IsNearTheHorizonUpToTheNearHorizonRadius) {
  for (const double spin : spacetime_spins) {
    const Spacetime spacetime{spin};
    EXPECT_TRUE(is_near_horizon(spacetime, near_horizon_radius(spacetime))) << spin;
    EXPECT_FALSE(is_near_horizon(spacetime, 1.001 * near_horizon_radius(spacetime))) << spin;
    EXPECT_TRUE(is_near_horizon(spacetime, min_interior_radius(spacetime))) << spin;
  }
}

TEST(Spacetime, PhotonOrbitsAreAtOneThreeAndFour) {
  EXPECT_NEAR(photon_orbit_radius(Spacetime{}, 1.0), 3.0, 1e-14);
  EXPECT_NEAR(photon_orbit_radius(Spacetime{1.0}, 1.0), 1.0, 1e-7);
  EXPECT_NEAR(photon_orbit_radius(Spacetime{1.0}, -1.0), 4.0, 1e-14);
}

TEST(Spacetime, PhotonOrbitsSolveTheirEquation) {
  // Equation of photon orbits: r^(3/2) - 3 r^(1/2) ± 2a = 0.
  for (const double spin : spacetime_spins) {
    for (const double sign : {1.0, -1.0}) {
      const double x = std::sqrt(photon_orbit_radius(Spacetime{spin}, sign));
      EXPECT_NEAR(x * x * x - 3.0 * x + 2.0 * sign * spin, 0.0, 1e-13) << spin << " " << sign;
    }
  }
}

TEST(Spacetime, PhotonOrbitsBoundTheSphericalOrbitsThatMakeTheShadowsEdge) {
  for (const auto& point : test::reference_edge()) {
    const CameraStation camera = test::station_of(point);
    const double u = radial_barrier(camera.spin, camera.horizon_r, start_ray(camera, point.n)).u;
    if (u == 0.0) {
      continue;  // light that comes to rest at the horizon of an extremal hole
    }
    const double along = photon_orbit_radius(Spacetime{point.a}, 1.0);
    const double against = photon_orbit_radius(Spacetime{point.a}, -1.0);
    EXPECT_GE(1.0 / u, (1.0 - 1e-6) * std::min(along, against)) << "camera " << point.camera;
    EXPECT_LE(1.0 / u, (1.0 + 1e-6) * std::max(along, against)) << "camera " << point.camera;
  }
}

TEST(Spacetime, InnermostStableOrbitsAreThoseOfBardeenPressTeukolsky) {
  EXPECT_NEAR(innermost_stable_radius(Spacetime{}, 1.0), 6.0, 1e-14);
  EXPECT_NEAR(innermost_stable_radius(Spacetime{1.0}, 1.0), 1.0, 1e-12);
  EXPECT_NEAR(innermost_stable_radius(Spacetime{1.0}, -1.0), 9.0, 1e-12);
  EXPECT_NEAR(innermost_stable_radius(Spacetime{-0.7}, -1.0), innermost_stable_radius(Spacetime{0.7}, 1.0), 1e-14);
}

TEST(Spacetime, InnermostStableOrbitsSolveTheirEquation) {
  // Equation of innermost stable orbits: r² - 6r ± 8a √r - 3a² = 0.
  for (const double spin : spacetime_spins) {
    for (const double sign : {1.0, -1.0}) {
      const double r = innermost_stable_radius(Spacetime{spin}, sign);
      EXPECT_NEAR(r * r - 6.0 * r + 8.0 * sign * spin * std::sqrt(r) - 3.0 * spin * spin, 0.0, 1e-12)
          << spin << " " << sign;
      EXPECT_GE(r, photon_orbit_radius(Spacetime{spin}, sign) - 1e-7) << spin << " " << sign;
    }
  }
}

TEST(Spacetime, StaticLimitTouchesTheHorizonOnTheAxis) {
  EXPECT_NEAR(static_limit_radius(Spacetime{0.9}, 0.0), horizon_radius(Spacetime{0.9}), 1e-15);
  EXPECT_NEAR(static_limit_radius(Spacetime{0.9}, pi / 2), 2.0, 1e-15);
}

TEST(Spacetime, TimeStandsStillForObserversAtRestAtTheStaticLimit) {
  // Condition for the static limit: g_tt = -(1 - 2r / Σ) = 0.
  for (const double spin : spacetime_spins) {
    for (const double theta : {0.0, 0.4, 1.2, pi / 2, 2.5}) {
      const double r = static_limit_radius(Spacetime{spin}, theta);
      const double sigma = r * r + spin * spin * std::cos(theta) * std::cos(theta);
      EXPECT_NEAR(2.0 * r / sigma, 1.0, 1e-13) << spin << " " << theta;
    }
  }
}

}  // namespace
}  // namespace ergodome
