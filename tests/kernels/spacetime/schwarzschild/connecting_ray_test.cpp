#include "kernels/spacetime/schwarzschild/connecting_ray.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <string>

#include "kernels/core/angles.h"
#include "tests/support/csv_table.h"

namespace ergodome {
namespace {

double lapse_squared(double r) { return 1.0 - 2.0 / r; }

double tortoise(double r) { return r + 2.0 * std::log(0.5 * r - 1.0); }

//! Follows a ray by the Runge-Kutta method in coordinate time, using only its direction at the
//! observer. Returns r, the cosine of the angle to the outward direction, φ, and the affine
//! distance at its end (from dλ/dt = 1 - 2/r).
std::array<double, 4> followed(double r_observer, double xi, double time) {
  const double b = r_observer * std::sin(xi) / std::sqrt(lapse_squared(r_observer));
  const auto change = [b](const std::array<double, 4>& s) {
    const double f = lapse_squared(s[0]);
    return std::array<double, 4>{f * s[1], b * b * f * (1.0 - 3.0 / s[0]) / (s[0] * s[0] * s[0]), b * f / (s[0] * s[0]),
                                 f};
  };
  const auto moved = [](const std::array<double, 4>& s, const std::array<double, 4>& d, double h) {
    return std::array<double, 4>{s[0] + h * d[0], s[1] + h * d[1], s[2] + h * d[2], s[3] + h * d[3]};
  };
  std::array<double, 4> state{r_observer, std::cos(xi), 0.0, 0.0};
  constexpr int steps = 20'000;
  const double h = time / steps;
  for (int i = 0; i < steps; ++i) {
    const auto k1 = change(state);
    const auto k2 = change(moved(state, k1, 0.5 * h));
    const auto k3 = change(moved(state, k2, 0.5 * h));
    const auto k4 = change(moved(state, k3, h));
    state = moved(moved(moved(moved(state, k1, h / 6), k2, h / 3), k3, h / 3), k4, h / 6);
  }
  return state;
}

TEST(ConnectingRay, AgreesWithTheReferenceTable) {
  const auto rows = test::read_csv(std::string(ERGODOME_TEST_DATA_DIR) + "/schwarzschild_pairs.csv");
  ASSERT_EQ(rows.size(), 72U);
  for (const auto& row : rows) {
    const ConnectingRay ray =
        connecting_ray(std::stod(row.at("r_obs")), std::stod(row.at("r")), std::stod(row.at("phi")));
    EXPECT_NEAR(ray.xi, std::stod(row.at("xi")), 1e-13) << row.at("r") << " " << row.at("phi");
    EXPECT_NEAR(ray.travel_time, std::stod(row.at("travel_time")), 1e-11) << row.at("r") << " " << row.at("phi");
  }
}

TEST(ConnectingRay, GivesTheExactValuesOfThePublishedTable) {
  // Values of table 1 in Müller, Schulz & Weiskopf (2021), recomputed in 113-bit arithmetic.
  const double expected[4][4] = {{6.6, 0.5 * pi, 169.046109924, 45.3344647},
                                 {16.5, 0.5 * pi, 155.492964839, 46.1737731},
                                 {6.6, 1.5 * pi, 172.334993307, 66.1959818},
                                 {16.5, 1.5 * pi, 171.983107483, 76.8526124}};
  for (const auto& [r, phi, xi_deg, time] : expected) {
    const ConnectingRay ray = connecting_ray(40.0, r, phi);
    EXPECT_NEAR(ray.xi * 180.0 / pi, xi_deg, 1e-9);
    EXPECT_NEAR(ray.travel_time, time, 1e-7);
  }
}

TEST(ConnectingRay, RaysFollowedFromTheObserverArriveAtThePoint) {
  const double pairs[][3] = {{20.0, 8.0, 1.0},  {20.0, 8.0, 0.2},   {20.0, 8.0, 3.0},
                             {20.0, 8.0, pi},   {20.0, 8.0, 5.0},  // on both sides of the turning point
                             {8.0, 20.0, 1.3},  {8.0, 20.0, 4.4},   {15.0, 15.0, 0.01},
                             {15.0, 15.0, 2.0}, {15.0, 15.1, 0.01},  // from closer in, and at the same radius
                             {20.0, 3.0, 2.0},  {20.0, 3.0, 6.0},   {3.0, 20.0, 6.0},
                             {3.0, 2.5, 4.0},   {2.9, 3.1, 5.0},  // at the photon sphere
                             {20.0, 2.1, 1.0},  {20.0, 2.1, 6.0},   {2.2, 30.0, 4.0},
                             {2.5, 2.2, 1.0},   {2.5, 2.2, 0.1},  // near the horizon
                             {2.5, 2.5, 0.5},   {2.1, 2.8, 3.0},    {2.05, 2.05, pi},
                             {4.0, 3.5, 0.3},   {3.5, 4.0, 5.5}};
  for (const auto& [r_observer, r, phi] : pairs) {
    const ConnectingRay ray = connecting_ray(r_observer, r, phi);
    const auto [r_end, cosine_end, phi_end, distance] = followed(r_observer, ray.xi, ray.travel_time);
    EXPECT_NEAR(ray.affine_distance, distance, 1e-8 * distance) << r_observer << " " << r << " " << phi;
    EXPECT_NEAR(r_end, r, 1e-8 * r) << r_observer << " " << r << " " << phi;
    EXPECT_NEAR(phi_end, phi, 1e-8) << r_observer << " " << r << " " << phi;
    EXPECT_NEAR(std::cos(ray.emission_angle), -cosine_end, 1e-8) << r_observer << " " << r << " " << phi;
  }
}

TEST(ConnectingRay, RatesAreThoseOfTheOrbitsEquation) {
  for (const auto& [r_observer, r, phi] :
       {std::array{20.0, 8.0, 1.0}, {20.0, 8.0, 4.0}, {2.2, 2.6, 3.0}, {2.5, 30.0, 1.0}}) {
    const ConnectingRay ray = connecting_ray(r_observer, r, phi);
    const double b = ray.impact_parameter;
    for (const auto& [at, rate, angle, to] : {std::array{r_observer, ray.rate_at_observer, ray.xi, 1.0},
                                              std::array{r, ray.rate_at_point, ray.emission_angle, -1.0}}) {
      EXPECT_NEAR(rate * rate, 1.0 / (b * b) - lapse_squared(at) / (at * at), 1e-14);
      EXPECT_NEAR(std::sin(angle), b * std::sqrt(lapse_squared(at)) / at, 1e-13);
      // u = 1/r grows where the ray, followed from the observer to the point, leads inward.
      EXPECT_EQ(rate > 0.0, to * std::cos(angle) < 0.0);
    }
  }
}

TEST(ConnectingRay, TravelTimeChangesByTheImpactParameterAndTheDirection) {
  // If the end of a ray at the observer moves, its travel time changes by dt/dφ = b, the impact
  // parameter, and dt/dr* = -cos ξ, where r* is the tortoise coordinate.
  for (const double r_observer : {2.01, 2.7, 3.0, 3.3, 20.0, 1e4}) {
    for (const double r : {2.02, 2.9, 3.01, 6.0, 50.0}) {
      for (const double phi : {0.3, 1.5, pi, 4.5, 6.2}) {
        const double h = 1e-4;
        const ConnectingRay ray = connecting_ray(r_observer, r, phi);
        const double turned =
            connecting_ray(r_observer, r, phi + h).travel_time - connecting_ray(r_observer, r, phi - h).travel_time;
        EXPECT_NEAR(turned / (2.0 * h), ray.impact_parameter, 1e-6 * ray.impact_parameter)
            << r_observer << " " << r << " " << phi;
        const double step = 1e-4 * (r_observer - 2.0);
        const double moved = connecting_ray(r_observer + step, r, phi).travel_time -
                             connecting_ray(r_observer - step, r, phi).travel_time;
        EXPECT_NEAR(moved * lapse_squared(r_observer) / (2.0 * step), -std::cos(ray.xi), 1e-6)
            << r_observer << " " << r << " " << phi;
      }
    }
  }
}

TEST(ConnectingRay, RadialRaysTakeTheTortoiseDistance) {
  const ConnectingRay inward = connecting_ray(20.0, 5.0, 0.0);
  EXPECT_EQ(inward.xi, pi);
  EXPECT_EQ(inward.emission_angle, 0.0);
  EXPECT_NEAR(inward.travel_time, tortoise(20.0) - tortoise(5.0), 1e-14 * 20.0);
  const ConnectingRay outward = connecting_ray(5.0, 20.0, 0.0);
  EXPECT_EQ(outward.xi, 0.0);
  EXPECT_EQ(outward.travel_time, inward.travel_time);
  // For small φ, deflection is negligible and b = φ / (1/5 - 1/20).
  for (const double phi : {1e-300, 1e-12, 1e-9, 1e-8, 1e-6}) {
    const ConnectingRay ray = connecting_ray(20.0, 5.0, phi);
    EXPECT_NEAR(ray.impact_parameter, phi / 0.15, 1e-11 * phi / 0.15 + 2.0 * phi * phi * phi) << phi;
    EXPECT_NEAR(ray.travel_time, inward.travel_time + 0.5 * phi * phi / 0.15, 1e-13) << phi;
  }
}

TEST(ConnectingRay, FarAwayAPointBehindTheHoleIsEinsteinsRing) {
  // Angular radius of Einstein's ring: θ² = 4 M D_LS / (D_L D_S), with the distances D_L from the
  // observer to the hole, D_S to the source, and D_LS between both. The next order would add a
  // relative 1e-4 here.
  const double r_observer = 1e8;
  const double r = 3e8;
  const ConnectingRay ray = connecting_ray(r_observer, r, pi);
  const double ring = std::sqrt(4.0 * r / (r_observer * (r_observer + r)));
  EXPECT_NEAR(pi - ray.xi, ring, 2e-4 * ring);
}

TEST(ConnectingRay, FarAwayTimeIsShapiros) {
  // Time delay by Weinberg (1972), eq. 8.7.4, from the closest approach r_0 to r. The terms that it
  // omits are of the order of M² / r_0.
  const double r_observer = 1e6;
  const double r = 2e6;
  const ConnectingRay ray = connecting_ray(r_observer, r, 3.0);
  double r0 = ray.impact_parameter;
  for (int round = 0; round < 20; ++round) {
    r0 = ray.impact_parameter * std::sqrt(lapse_squared(r0));
  }
  double time = 0.0;
  for (const double end : {r_observer, r}) {
    const double flat = std::sqrt(end * end - r0 * r0);
    time += flat + 2.0 * std::log((end + flat) / r0) + std::sqrt((end - r0) / (end + r0));
  }
  EXPECT_GT(r0, 5e4);
  EXPECT_NEAR(ray.travel_time, time, 2e-4);
}

TEST(ConnectingRay, WithoutAHoleNearbyRaysAreStraight) {
  // Beyond 1e9 M, the deflection of light is less than 1e-8.
  const double r_observer = 2e9;
  const double r = 1e9;
  const double phi = 1.2;
  const ConnectingRay ray = connecting_ray(r_observer, r, phi);
  EXPECT_NEAR(ray.xi, std::atan2(r * std::sin(phi), r * std::cos(phi) - r_observer), 1e-8);
  EXPECT_NEAR(ray.travel_time, std::hypot(r * std::sin(phi), r * std::cos(phi) - r_observer), 1e-7 * r);
}

TEST(ConnectingRay, RunsRoundThePhotonSphere) {
  for (const double phi : {0.1, pi, 20.0}) {
    const ConnectingRay ray = connecting_ray(3.0, 3.0, phi);
    EXPECT_NEAR(ray.xi, 0.5 * pi, 1e-15);
    EXPECT_NEAR(ray.travel_time, std::sqrt(27.0) * phi, 1e-13 * phi);
    for (const double apart : {-1e-3, -1e-9, -1e-14, 1e-14, 1e-9, 1e-3}) {
      const ConnectingRay beside = connecting_ray(3.0 + apart, 3.0 - 0.5 * apart, phi);
      EXPECT_NEAR(beside.travel_time, ray.travel_time,
                  10.0 * apart * apart * (1.0 + 1.0 / phi) + 1e-14 * (1.0 + ray.travel_time))
          << apart;
      EXPECT_NEAR(beside.xi, ray.xi, 20.0 * std::abs(apart) + 1e-13) << apart;
    }
  }
}

TEST(ConnectingRay, NothingJumpsWhereAPointCrossesThePhotonSphere) {
  for (const double phi : {0.5, pi, 5.0}) {
    const ConnectingRay at = connecting_ray(20.0, 3.0, phi);
    for (const double apart : {-1e-6, -1e-12, 1e-12, 1e-6}) {
      const ConnectingRay beside = connecting_ray(20.0, 3.0 + apart, phi);
      EXPECT_NEAR(beside.xi, at.xi, std::abs(apart) + 1e-14) << phi;
      EXPECT_NEAR(beside.travel_time, at.travel_time, 3.0 * std::abs(apart) + 1e-13) << phi;
    }
  }
}

TEST(ConnectingRay, TowardsTheHorizonOnlyTheTortoiseDistanceGrows) {
  // Near the horizon, the travel time without its divergent part converges, because light leaves
  // the horizon radially.
  for (const double phi : {0.0, 1.0, pi, 5.0}) {
    const auto rest = [phi](double above) {
      const double r = 2.0 + above;
      const double exactly_above = r - 2.0;
      return connecting_ray(20.0, r, phi).travel_time + r + 2.0 * std::log(0.5 * exactly_above);
    };
    EXPECT_NEAR(rest(1e-9), rest(1e-12), 1e-7) << phi;
    EXPECT_NEAR(connecting_ray(20.0, 2.0 + 1e-12, phi).emission_angle, 0.0, 1e-5) << phi;
  }
}

TEST(ConnectingRay, EachTurnMoreTakesThePhotonSpheresPeriod) {
  const double turn = 2.0 * pi * std::sqrt(27.0);
  const ConnectingRay fifth = connecting_ray(20.0, 8.0, 4.0 * pi + 1.0);
  const ConnectingRay seventh = connecting_ray(20.0, 8.0, 6.0 * pi + 1.0);
  EXPECT_NEAR(seventh.travel_time - fifth.travel_time, turn, 1e-4);
  EXPECT_NEAR(seventh.xi, pi - std::asin(std::sqrt(27.0 * 0.9) / 20.0), 1e-7);
  EXPECT_TRUE(std::isfinite(connecting_ray(20.0, 8.0, 600.0).travel_time));
}

TEST(ConnectingRay, SaysWhyThereIsNoRay) {
  EXPECT_EQ(why_not_connected(20.0, 8.0, 1.0), nullptr);
  EXPECT_EQ(why_not_connected(20.0, 20.0, 1e-9), nullptr);
  EXPECT_NE(why_not_connected(20.0, 20.0, 0.0), nullptr);
  EXPECT_NE(why_not_connected(20.0, 2.0, 1.0), nullptr);
  EXPECT_NE(why_not_connected(-20.0, 8.0, 1.0), nullptr);
  EXPECT_NE(why_not_connected(20.0, 8.0, -0.1), nullptr);
  EXPECT_NE(why_not_connected(20.0, 2e12, 1.0), nullptr);
  EXPECT_NE(why_not_connected(20.0, std::nan(""), 1.0), nullptr);
}

TEST(ImageAngle, TellsHowFarTheRayOfAnImageSweeps) {
  EXPECT_EQ(image_angle(1.0, 1), 1.0);
  EXPECT_DOUBLE_EQ(image_angle(1.0, 2), 2.0 * pi - 1.0);
  EXPECT_DOUBLE_EQ(image_angle(1.0, 3), 2.0 * pi + 1.0);
  EXPECT_EQ(image_angle(4.0, 2), 4.0);
  EXPECT_DOUBLE_EQ(image_angle(4.0, 1), 2.0 * pi - 4.0);
  EXPECT_EQ(image_angle(pi, 1), pi);
  EXPECT_EQ(image_angle(pi, 2), pi);
}

}  // namespace
}  // namespace ergodome
