#include "kernels/disk/page_thorne.h"

#include <gtest/gtest.h>

#include <cmath>

namespace ergodome {
namespace {

//! Computes the integral that defines the function f (Page & Thorne, eq. 12): f = -Ω' / (E - ΩL)² ∫
//! (E - ΩL) L' dr, from the innermost stable orbit on. The integral is a sum of (E - ΩL) over steps
//! of L, of second order, improved by one extrapolation.
double integrated_function(double spin, double r) {
  const double inner = innermost_stable_radius(Spacetime{spin}, 1.0);
  const auto rotation = [&](double at) { return 1.0 / (at * std::sqrt(at) + spin); };
  const auto co_moving = [&](double at) {
    const CircularOrbit orbit = circular_orbit(Spacetime{spin}, at);
    return orbit.energy - rotation(at) * orbit.axial_angular_momentum;
  };
  constexpr int steps = 4000;
  const auto stieltjes = [&](int count) {
    double total = 0.0;
    for (int i = 0; i < count; ++i) {
      const double low = inner + (r - inner) * i / count;
      const double high = inner + (r - inner) * (i + 1) / count;
      total += co_moving(0.5 * (low + high)) * (circular_orbit(Spacetime{spin}, high).axial_angular_momentum -
                                                circular_orbit(Spacetime{spin}, low).axial_angular_momentum);
    }
    return total;
  };
  const double sum = (4.0 * stieltjes(2 * steps) - stieltjes(steps)) / 3.0;
  const double slope = -1.5 * std::sqrt(r) * rotation(r) * rotation(r);  // Ω'
  return -slope / (co_moving(r) * co_moving(r)) * sum;
}

TEST(PageThorne, IsTheIntegralThatDefinesIt) {
  for (const double spin : {-0.95, -0.5, 0.0, 0.3, 0.7, 0.95, 0.998}) {
    const double inner = innermost_stable_radius(Spacetime{spin}, 1.0);
    for (const double beyond : {0.5, 2.0, 10.0, 50.0}) {
      const double r = inner + beyond;
      EXPECT_NEAR(page_thorne_function(Spacetime{spin}, r) / integrated_function(spin, r), 1.0, 1e-6)
          << spin << " " << r;
    }
  }
}

TEST(PageThorne, HasNoTorqueAtTheLastStableOrbit) {
  for (const double spin : {-1.0, -0.6, 0.0, 0.6, 0.999}) {
    const double inner = innermost_stable_radius(Spacetime{spin}, 1.0);
    EXPECT_EQ(page_thorne_flux(Spacetime{spin}, inner), 0.0) << spin;
    // At the inner edge, the flux grows with the square of the distance from the edge.
    const double near = page_thorne_flux(Spacetime{spin}, inner + 1e-3);
    const double nearer = page_thorne_flux(Spacetime{spin}, inner + 5e-4);
    EXPECT_NEAR(near / nearer, 4.0, 0.05) << spin;
  }
}

TEST(PageThorne, IsNewtonsDiskFarAway) {
  // Newton's result for the flux is 3 M Ṁ / (8π r³) (1 - √(r_in / r)). At large r, the bracket
  // differs from 1 only by the effect of the inner edge.
  const double r = 1e6;
  EXPECT_NEAR(page_thorne_flux(Spacetime{0.5}, r) * r * r * r, 1.5, 1.5 * 4e-3);
}

TEST(PageThorne, HasTheClosedFormOfFullSpin) {
  // If a = 1, the roots of the cubic are 1, 1 and -2, and the integral in x = √r becomes ∫ (1 - 3 /
  // (x (x + 2))) dx, from x = 1 on.
  for (const double r : {1.5, 3.0, 20.0}) {
    const double x = std::sqrt(r);
    const double bracket = x - 1.0 - 1.5 * std::log(3.0 * x / (x + 2.0));
    const double expected = 1.5 * bracket / (r * (x * r - 3.0 * x + 2.0));
    EXPECT_NEAR(page_thorne_function(Spacetime{1.0}, r) / expected, 1.0, 1e-12) << r;
    EXPECT_NEAR(page_thorne_function(Spacetime{1.0 - 1e-12}, r) / expected, 1.0, 2e-3) << r;
  }
}

TEST(PageThorne, GoesOnSmoothlyThroughSpinZeroAndToFullSpinAgainstTheHole) {
  EXPECT_NEAR(page_thorne_function(Spacetime{1e-9}, 10.0) / page_thorne_function(Spacetime{0.0}, 10.0), 1.0, 1e-8);
  EXPECT_NEAR(page_thorne_function(Spacetime{-1.0 + 1e-8}, 12.0) / page_thorne_function(Spacetime{-1.0}, 12.0), 1.0,
              1e-6);
}

TEST(PageThorne, PeaksWhereItIsPublishedToForNoSpin) {
  // The published maximum of the flux of a disk around a hole without spin is at r = 9.55 M.
  double best = 6.0;
  for (double r = 6.0; r < 20.0; r += 0.001) {
    best = page_thorne_flux(Spacetime{0.0}, r) > page_thorne_flux(Spacetime{0.0}, best) ? r : best;
  }
  EXPECT_NEAR(best, 9.55, 0.01);
}

}  // namespace
}  // namespace ergodome
