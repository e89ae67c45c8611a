#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "kernels/core/angles.h"
#include "kernels/disk/disk_emitter.h"
#include "kernels/disk/equatorial_crossings.h"
#include "kernels/spacetime/geodesic/polar_closed_form.h"
#include "tests/kernels/reference_tables.h"

namespace ergodome::test {
namespace {

constexpr CrossingLimits<double> finest_crossings = {1e-7, 1e-15, 4000};

using Crossings = EquatorialCrossing<double>[crossing_orders];

double azimuth_of(const EquatorialCrossing<double>& c) { return std::atan2(c.y, c.x) + c.drag; }

double angle_between(double a, double b) { return std::abs(std::remainder(a - b, 2.0 * pi)); }

DiskLight<double> light_of(const NearRay<double>& ray, const EquatorialCrossing<double>& c) {
  return {1.0 / c.u, ray.energy, ray.axial_angular_momentum, ray.shear_constant, c.u_rate > 0.0};
}

//! A ray of a row of the reference table, and its traced crossings of the equatorial plane.
struct Traced {
  NearRay<double> ray;
  Crossings crossings;
  bool finished;
};

Traced trace(const ReferenceCrossing& row) {
  const CameraStation camera = station_of(row);
  Traced t{};
  t.ray = start_near_ray(camera, row.n);
  t.finished = trace_crossings<20, true>(camera.spin, t.ray, finest_crossings, true, t.crossings);
  return t;
}

TEST(DiskCrossings, HaveTheReferenceRadius) {
  for (const ReferenceCrossing& row : reference_crossings()) {
    const Traced t = trace(row);
    ASSERT_TRUE(t.finished) << row.id;
    EXPECT_NEAR(1.0 / t.crossings[row.order].u, row.r_hit, 1e-9) << row.id;
  }
}

TEST(DiskCrossings, HaveTheReferenceAzimuth) {
  for (const ReferenceCrossing& row : reference_crossings()) {
    EXPECT_LT(angle_between(azimuth_of(trace(row).crossings[row.order]), row.phi_hit), 1e-9) << row.id;
  }
}

TEST(DiskCrossings, HaveTheReferenceDelay) {
  for (const ReferenceCrossing& row : reference_crossings()) {
    EXPECT_NEAR(trace(row).crossings[row.order].delay, row.delay, 1e-9) << row.id;
  }
}

TEST(DiskCrossings, HaveTheReferenceShift) {
  for (const ReferenceCrossing& row : reference_crossings()) {
    const Traced t = trace(row);
    EXPECT_NEAR(1.0 / circular_frequency(row.a, light_of(t.ray, t.crossings[row.order])), row.g_kepler, 1e-9) << row.id;
  }
}

TEST(DiskCrossings, AreTheSameWithoutTheDelay) {
  for (const ReferenceCrossing& row : reference_crossings()) {
    const CameraStation camera = station_of(row);
    const NearRay<double> ray = start_near_ray(camera, row.n);
    Crossings crossings;
    ASSERT_TRUE((trace_crossings<20, false>(camera.spin, ray, finest_crossings, true, crossings)));
    EXPECT_NEAR(1.0 / crossings[row.order].u, row.r_hit, 1e-9) << row.id;
  }
}

TEST(DiskCrossings, AreWhereThePicturesFloatSeesThem) {
  for (const ReferenceCrossing& row : reference_crossings()) {
    const auto camera = converted_station<float>(station_of(row));
    const Vector3<float> n = {static_cast<float>(row.n.x), static_cast<float>(row.n.y), static_cast<float>(row.n.z)};
    EquatorialCrossing<float> crossings[crossing_orders];
    trace_crossings<10, true>(camera.spin, start_near_ray(camera, n), {1e-3F, 1e-6F, 200}, true, crossings);
    // Images of higher order amplify the rounding of directions to float.
    const double allowed = row.order == 0 ? 2e-4 : 5e-3;
    EXPECT_NEAR(1.0 / static_cast<double>(crossings[row.order].u) / row.r_hit, 1.0, allowed) << row.id;
  }
}

TEST(DiskCrossings, LieInThePlaneByTheClosedFormOfThePolarMotion) {
  // Checks a crossing by a closed form: an elliptic function gives the polar position at any Mino
  // time, and the Mino time of the crossing is the integral of the radial motion.
  std::mt19937_64 random(5);
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  const CameraStation camera = make_camera_station(Spacetime{0.9}, 12.0, 1.2, 0.0, ObserverMotion::zamo);
  for (int i = 0; i < 200; ++i) {
    const Vector3<double> raw = {-1.0, 0.5 * unit(random), 0.5 * unit(random)};
    const Vector3<double> n = (1.0 / length(raw)) * raw;
    const NearRay<double> ray = start_near_ray(camera, n);
    Crossings crossings;
    ASSERT_TRUE((trace_crossings<20, true>(camera.spin, ray, finest_crossings, true, crossings)));
    if (crossings[0].u <= 0.0) {
      continue;
    }
    const RayStart<double> plain = start_ray(camera, n);
    const double slowness = std::sqrt(radial_potential(camera.spin, plain, crossings[0].u));
    EXPECT_NEAR(std::abs(crossings[0].u_rate) / ray.energy, slowness, 1e-9 * (1.0 + slowness));
    // Compares φ, without frame dragging, with the closed form at the Mino time of the crossing.
    // This time is found by bisection.
    double low = 0.0;
    double high = 2.0 / std::sqrt(plain.polar_constant);
    while (polar_position(camera.spin, plain, high).z > 0.0) {
      low = high;
      high *= 1.1;
    }
    for (int round = 0; round < 60; ++round) {
      const double middle = 0.5 * (low + high);
      (polar_position(camera.spin, plain, middle).z > 0.0 ? low : high) = middle;
    }
    const Vector3<double> m = polar_position(camera.spin, plain, low);
    EXPECT_LT(angle_between(std::atan2(m.y, m.x), std::atan2(crossings[0].y, crossings[0].x)), 1e-9);
  }
}

TEST(DiskCrossings, AreNoneForLightThatStaysInThePlane) {
  const CameraStation camera = make_camera_station(Spacetime{0.5}, 10.0, 0.5 * pi, 0.0, ObserverMotion::zamo);
  Crossings crossings;
  EXPECT_TRUE((trace_crossings<20, true>(0.5, start_near_ray(camera, Vector3<double>{-1.0, 0.0, 0.0}), finest_crossings,
                                         true, crossings)));
  EXPECT_EQ(crossings[0].u, 0.0);
}

TEST(DiskCrossings, BelowTheHoleAreMirrorImagesOfThoseAbove) {
  for (const ReferenceCrossing& row : reference_crossings()) {
    const Traced above = trace(row);
    const Vector3<double> velocity = {row.beta.x, -row.beta.y, row.beta.z};
    const CameraStation camera =
        make_camera_station(Spacetime{row.a}, row.r, pi - row.theta, 0.0, row.motion, velocity);
    Crossings below;
    trace_crossings<20, true>(camera.spin, start_near_ray(camera, Vector3<double>{row.n.x, -row.n.y, row.n.z}),
                              finest_crossings, true, below);
    EXPECT_NEAR(below[row.order].u, above.crossings[row.order].u, 1e-12) << row.id;
  }
}

TEST(DiskCrossings, ComeInOrderOfTheDelay) {
  int second = 0;
  for (const ReferenceCrossing& row : reference_crossings()) {
    const Traced t = trace(row);
    for (int order = 1; order < crossing_orders && t.crossings[order].u > 0.0; ++order) {
      EXPECT_GT(t.crossings[order].delay, t.crossings[order - 1].delay) << row.id;
      ++second;
    }
  }
  EXPECT_GT(second, 5);
}

//! Returns 1/r of the first crossing of a ray; 0 if there is none.
template <int Order>
double first_crossing(const CameraStation& camera, const Vector3<double>& n, double tolerance) {
  Crossings crossings;
  trace_crossings<Order, false>(camera.spin, start_near_ray(camera, n), {1e-3, tolerance, 4000}, true, crossings);
  return crossings[0].u;
}

TEST(DiskCrossings, AreFoundBesideTheHorizonByLongStepsAsByShortOnes) {
  // A single long step may lead outwards, through the equatorial plane, around the hole and back to
  // this plane.
  const CameraStation camera = make_camera_station(Spacetime{0.6}, 1.802, 1.36, 0.0, ObserverMotion::rain);
  for (int i = 0; i < 16; ++i) {
    for (int j = 0; j < 16; ++j) {
      const Vector3<double> down = {-0.97, 0.1 + 0.015 * i, -0.2 + 0.03 * j};
      const Vector3<double> n = (1.0 / length(down)) * down;
      EXPECT_NEAR(first_crossing<10>(camera, n, 1e-4), first_crossing<20>(camera, n, 1e-15), 1e-3) << i << ' ' << j;
    }
  }
}

TEST(DiskCrossings, EndWithTheFirstBehindTheHorizon) {
  // Crossings after the first one inside the horizon must not be reported: they are not continuous
  // with crossings outside the horizon, and a linear footprint would connect both.
  std::mt19937 random(9);
  std::uniform_real_distribution<double> part(-1.0, 1.0);
  int behind = 0;
  const double horizon = horizon_radius(Spacetime{0.999});
  const CameraStation camera = make_camera_station(Spacetime{0.999}, 1.094, 1.45, 0.0, ObserverMotion::rain);
  for (int i = 0; i < 1000; ++i) {
    const Vector3<double> any = {-1.0, 0.02 * part(random), 0.02 * part(random)};
    Crossings crossings;
    trace_crossings<10, false>(0.999, start_near_ray(camera, (1.0 / length(any)) * any), {1e-3, 1e-6, 400}, true,
                               crossings);
    for (int order = 0; order < crossing_orders; ++order) {
      if (crossings[order].u * horizon > 1.0) {
        ++behind;
        EXPECT_TRUE(order + 1 == crossing_orders || crossings[order + 1].u == 0.0) << i;
      }
    }
  }
  EXPECT_GT(behind, 50);
}

TEST(DiskFlow, MovesAlongPhiWhateverTheSpin) {
  // Published radii of the innermost stable orbit: 9 M for orbits against the rotation of a hole of
  // spin 1, 1 M for orbits with it, 6 M without spin.
  EXPECT_NEAR(make_disk_flow(Spacetime{-1.0}).stable_r, 9.0, 1e-12);
  EXPECT_NEAR(make_disk_flow(Spacetime{0.0}).stable_r, 6.0, 1e-12);
  EXPECT_NEAR(make_disk_flow(Spacetime{1.0}).stable_r, 1.0, 1e-12);
}

TEST(DiskFlow, HasTheBindingEnergyOfTheLastStableOrbit) {
  // The published binding energies per mass are 1 - √(8/9), 1 - √(1/3) and 1 - √(25/27).
  EXPECT_NEAR(make_disk_flow(Spacetime{0.0}).energy, std::sqrt(8.0 / 9.0), 1e-14);
  EXPECT_NEAR(make_disk_flow(Spacetime{1.0}).energy, std::sqrt(1.0 / 3.0), 1e-14);
  EXPECT_NEAR(make_disk_flow(Spacetime{-1.0}).energy, std::sqrt(25.0 / 27.0), 1e-14);
}

TEST(DiskFlow, ReachesItsLimitAtFullSpin) {
  const DiskFlow<double> near = make_disk_flow(Spacetime{1.0 - 1e-9});
  EXPECT_NEAR(near.energy, make_disk_flow(Spacetime{1.0}).energy, 2e-3);
  EXPECT_NEAR(near.axial_angular_momentum, make_disk_flow(Spacetime{1.0}).axial_angular_momentum, 4e-3);
}

TEST(DiskFlow, FallsWithoutAJumpFromTheLastStableOrbit) {
  for (const double spin : {-0.7, 0.0, 0.5, 0.9}) {
    const DiskFlow<double> flow = make_disk_flow(Spacetime{spin});
    const DiskLight<double> light = {flow.stable_r, 1.0, 1.3, 8.0, true};
    EXPECT_NEAR(plunging_frequency(flow, light) / circular_frequency(spin, light), 1.0, 1e-6) << spin;
  }
}

TEST(DiskFlow, SeesItsOwnFrequencyByTheMetric) {
  // Light moves along a principal null direction (L = a E), and matter falls into a hole without
  // spin. The frequency in the frame of the matter is ν = (E_m + √(E_m² - f (1 + L²/r²))) / f for
  // outgoing light, with f = 1 - 2/r and the energy E_m and angular momentum L = √12 of the matter.
  const DiskFlow<double> flow = make_disk_flow(Spacetime{0.0});
  const double r = 4.0;
  const double f = 1.0 - 2.0 / r;
  const double fall = std::sqrt(flow.energy * flow.energy - f * (1.0 + 12.0 / (r * r)));
  EXPECT_NEAR(plunging_frequency(flow, {r, 1.0, 0.0, 0.0, true}), (flow.energy + fall) / f, 1e-12);
  EXPECT_NEAR(plunging_frequency(flow, {r, 1.0, 0.0, 0.0, false}), (flow.energy - fall) / f, 1e-12);
}

//! Computes plunging_frequency() for ingoing light by its textbook formula, which loses digits near
//! the horizon because terms cancel.
double frequency_by_difference(const DiskFlow<double>& flow, const DiskLight<double>& light) {
  const double a = flow.spin;
  const double delta = light.r * light.r - 2.0 * light.r + a * a;
  const double x = (light.r * light.r + a * a) * light.energy - a * light.axial_angular_momentum;
  const double p = (light.r * light.r + a * a) * flow.energy - a * flow.axial_angular_momentum;
  const double skew = flow.axial_angular_momentum - a * flow.energy;
  const double light_skew = light.axial_angular_momentum - a * light.energy;
  const double w = std::sqrt(x * x - delta * light.shear_constant);
  const double v = std::sqrt(p * p - delta * (light.r * light.r + skew * skew));
  return ((x * p - w * v) / delta - skew * light_skew) / (light.r * light.r);
}

TEST(DiskFlow, IsSeenInFloatAsItIsBesideTheHorizon) {
  std::mt19937 random(4);
  std::uniform_real_distribution<double> part(0.0, 1.0);
  int seen = 0;
  for (const float spin_in_float : {0.3F, 0.9F, 0.998F, 0.9999F}) {
    const auto spin = static_cast<double>(spin_in_float);
    const DiskFlow<double> flow = make_disk_flow(Spacetime{spin});
    const double horizon = horizon_radius(Spacetime{spin});
    for (int i = 0; i < 4000; ++i) {
      // Light that comes from outside the hole, so that X = (r² + a²) E - a L is positive at the
      // horizon. Its energy at infinity may have any value, also a negative one, as in the
      // ergosphere.
      const double energy = 2.0 * part(random) - 1.0;
      const double brink = std::pow(10.0, -2.0 * part(random));
      const double max_above = 0.9 * (flow.stable_r - horizon);
      const auto r = static_cast<float>(horizon + std::pow(5e-4 / max_above, part(random)) * max_above);
      const DiskLight<float> light = {r, static_cast<float>(energy),
                                      static_cast<float>((2.0 * horizon * energy - brink) / spin),
                                      static_cast<float>(40.0 * part(random)), false};
      const DiskLight<double> wide = {static_cast<double>(light.r), static_cast<double>(light.energy),
                                      static_cast<double>(light.axial_angular_momentum),
                                      static_cast<double>(light.shear_constant), false};
      const double skew = wide.axial_angular_momentum - spin * wide.energy;
      const double x = wide.r * wide.r * wide.energy - spin * skew;
      const double delta = (wide.r - horizon) * (wide.r - inner_horizon_radius(Spacetime{spin}));
      if (x < 0.1 * brink || wide.shear_constant < skew * skew || wide.shear_constant * delta > x * x) {
        continue;
      }
      ++seen;
      const auto found = static_cast<double>(plunging_frequency(converted_flow<float>(flow), light));
      EXPECT_NEAR(found / frequency_by_difference(flow, wide), 1.0, 1e-3) << spin << ' ' << r << ' ' << energy;
    }
  }
  EXPECT_GT(seen, 2000);
}

}  // namespace
}  // namespace ergodome::test
