#include <gtest/gtest.h>

#include <cmath>
#include <optional>
#include <random>

#include "kernels/core/angles.h"
#include "kernels/disk/crossing_layers.h"
#include "kernels/disk/disk_emitter.h"
#include "kernels/objects/path_step.h"
#include "kernels/shells/shell_crossings.h"
#include "kernels/spacetime/shadow/shadow_chart.h"
#include "tests/kernels/reference_tables.h"

// Tests of the disk outside the horizon, as seen by a camera inside the horizon.
namespace ergodome::test {
namespace {

//! A point outside the horizon from which light comes.
struct OuterPoint {
  double r;
  double azimuth;
  double delay;
};

double turn_between(double a, double b) { return std::abs(std::remainder(a - b, 2.0 * pi)); }

void expect_position(const ReferenceCrossing& row, const std::optional<OuterPoint>& position, double allowed) {
  ASSERT_TRUE(position) << "ray " << row.id;
  EXPECT_NEAR(position->r / row.r_hit, 1.0, allowed) << "ray " << row.id;
  EXPECT_LT(turn_between(position->azimuth, row.phi_hit), allowed) << "ray " << row.id;
  EXPECT_NEAR(position->delay, row.delay, allowed * std::max(1.0, row.r_hit)) << "ray " << row.id;
}

//! Finds the point where a ray crosses the disk's plane outside the horizon, by trace_crossings(),
//! which also computes azimuth and time.
template <class S>
std::optional<OuterPoint> traced_crossing(const ReferenceCrossing& row, const CrossingLimits<S>& limits) {
  const CameraStationOf<S> camera = converted_station<S>(station_of(row));
  const Vector3<S> n = {static_cast<S>(row.n.x), static_cast<S>(row.n.y), static_cast<S>(row.n.z)};
  EquatorialCrossing<S> crossings[crossing_orders];
  trace_crossings<sizeof(S) == 4 ? 10 : 20, true>(camera.spin, start_near_ray(camera, n), limits, true, crossings);
  const EquatorialCrossing<S>& c = crossings[row.order];
  if (!(c.u > S(0))) {
    return std::nullopt;
  }
  return OuterPoint{1.0 / static_cast<double>(c.u), static_cast<double>(std::atan2(c.y, c.x) + c.drag),
                    static_cast<double>(c.delay)};
}

TEST(CrossingsFromWithin, AreWhereTheReferenceHasThem) {
  for (const ReferenceCrossing& row : reference_crossings_within()) {
    expect_position(row, traced_crossing<double>(row, {1e-7, 1e-15, 4000}), 1e-9);
  }
}

TEST(CrossingsFromWithin, AreThereInFloat) {
  for (const ReferenceCrossing& row : reference_crossings_within()) {
    expect_position(row, traced_crossing<float>(row, {1e-3F, 1e-6F, 200}), 1e-3);
  }
}

TEST(CrossingsFromWithin, HaveTheSameOrderWithoutAzimuthAndTime) {
  for (const ReferenceCrossing& row : reference_crossings_within()) {
    EquatorialCrossing<double> crossings[crossing_orders];
    trace_crossings<20, false>(row.a, start_near_ray(station_of(row), row.n), {1e-7, 1e-15, 4000}, true, crossings);
    EXPECT_NEAR(1.0 / crossings[row.order].u / row.r_hit, 1.0, 1e-11) << "ray " << row.id;
  }
}

TEST(CrossingsFromWithin, ShowADiskShiftedAsTheReferenceSays) {
  for (const ReferenceCrossing& row : reference_crossings_within()) {
    const NearRay<double> ray = start_near_ray(station_of(row), row.n);
    if (row.g_kepler > 0.0) {
      const DiskLight<double> light = {row.r_hit, ray.energy, ray.axial_angular_momentum, ray.shear_constant, false};
      EXPECT_NEAR(1.0 / circular_frequency(row.a, light) / row.g_kepler, 1.0, 1e-11) << "ray " << row.id;
    }
  }
}

//! Finds the point outside the horizon where a ray crosses the disk's plane, among the crossings of
//! any order in the layers of a disk grid. These layers also contain crossings inside the horizon.
std::optional<OuterPoint> layer_crossing(const ReferenceCrossing& row) {
  const double near_u = 1.0 / (horizon_radius(Spacetime{row.a}) + 1e-3);
  const LayerLimits<double> limits = {near_u, 1e-4, 10.0, -1.0, 1e-15, 4000};
  CrossingLayer<double> layers[crossing_orders];
  trace_layers<20, NearParts::azimuth_and_delay>(row.a, start_near_ray(station_of(row), row.n), limits, layers);
  const HorizonWinding<double> horizon = horizon_winding(row.a, true);
  for (const CrossingLayer<double>& layer : layers) {
    if (std::abs(1.0 / layer.u / row.r_hit - 1.0) < 1e-6) {
      const double wound = winding(horizon, layer.u);
      return OuterPoint{1.0 / layer.u, std::atan2(layer.sine, layer.cosine) + winding_turn(horizon) * wound,
                        layer.delay + winding_delay(horizon) * wound};
    }
  }
  return std::nullopt;
}

TEST(CrossingsFromWithin, AreTheLayersOfADisksGrid) {
  for (const ReferenceCrossing& row : reference_crossings_within()) {
    expect_position(row, layer_crossing(row), 1e-9);
  }
}

//! A visitor for trace_shells() that keeps the shell crossing closest to the equatorial plane.
struct EquatorialVisitor {
  std::optional<OuterPoint> found;
  double height = 1.0;

  void cross(int, bool crosses, const NearPosition<double>& position) {
    if (crosses && std::abs(position.m.z) < height) {
      height = std::abs(position.m.z);
      found = {1.0 / position.u, std::atan2(position.m.y, position.m.x) + position.drag, position.delay};
    }
  }
  void turn(bool, const NearPosition<double>&) {}
  [[nodiscard]] bool done() const { return false; }
};

TEST(CrossingsFromWithin, AreThoseOfShellsThroughThem) {
  for (const ReferenceCrossing& row : reference_crossings_within()) {
    const double u = 1.0 / row.r_hit;
    EquatorialVisitor visitor;
    trace_shells<20, NearParts::azimuth_and_delay>(row.a, start_near_ray(station_of(row), row.n), {&u, 1},
                                                   {1e-15, 4000}, true, visitor);
    expect_position(row, visitor.found, 1e-9);
  }
}

//! Finds the point outside the horizon where a ray crosses the disk's plane, on the paths that are
//! used to search for objects. Computes azimuth and delay where a path crosses that plane.
std::optional<OuterPoint> path_crossing(const ReferenceCrossing& row) {
  std::optional<OuterPoint> found;
  int order = 0;
  const RadialBounds bounds = {horizon_radius(Spacetime{row.a}) * 1.001, 100.0};
  follow_path<16, NearParts::azimuth_and_delay>(
      row.a, 1.0, 0.0, start_near_ray(station_of(row), row.n), bounds, MeshLimits{1e-14, 4000}, true,
      [&](int, const PathStep<16, NearParts::azimuth_and_delay, double>& step) {
        const auto height = [&](double h) { return step.point(h).z; };
        if (!found && height(0.0) * height(step.length) < 0.0 && order++ == row.order) {
          const double h = detail::time_to_zero(step.series.z, height(0.0), 0.0, step.length);
          const Vector3<double> at = step.point(h);
          found = {std::hypot(at.x, at.y), std::atan2(at.y, at.x), step.delay(h)};
        }
        return found.has_value();
      });
  return found;
}

TEST(CrossingsFromWithin, AreOnThePathsOfObjects) {
  for (const ReferenceCrossing& row : reference_crossings_within()) {
    expect_position(row, path_crossing(row), 1e-9);
  }
}

//! Returns the first crossing of the disk's plane. Azimuth and time are those of ingoing Kerr
//! coordinates at the camera. r is 0 if there is no crossing.
OuterPoint crossing_by_ingoing_clock(double spin, double r, const Vector3<double>& n) {
  const CameraStation camera = make_camera_station(Spacetime{spin}, r, 1.2, 0.0, ObserverMotion::rain);
  EquatorialCrossing<double> found[crossing_orders];
  trace_crossings<20, true>(spin, start_near_ray(camera, normalized(n)), {1e-7, 1e-14, 4000}, true, found);
  const EquatorialCrossing<double>& c = found[0];
  const bool outside = r > horizon_radius(Spacetime{spin});
  return {c.u > 0.0 ? 1.0 / c.u : 0.0,
          std::atan2(c.y, c.x) + c.drag - (outside ? ingoing_turn(Spacetime{spin}, r) : 0.0),
          c.delay - (outside ? ingoing_lag(Spacetime{spin}, r) : 0.0)};
}

TEST(CrossingsFromWithin, GoOnFromOutsideWithTheLagOfTheCamerasTime) {
  for (const double spin : {0.0, -0.6, 0.9, 0.999}) {
    int seen = 0;
    for (const Vector3<double> n : {Vector3<double>{0.6, 0.7, -0.2}, {0.5, 0.8, 0.3}, {0.2, 0.9, -0.1}}) {
      const double horizon = horizon_radius(Spacetime{spin});
      const OuterPoint above = crossing_by_ingoing_clock(spin, horizon + 1e-8, n);
      const OuterPoint below = crossing_by_ingoing_clock(spin, horizon - 1e-8, n);
      if (below.r > 0.0) {
        ++seen;
        EXPECT_NEAR(above.r, below.r, 1e-6) << "spin " << spin;
        EXPECT_LT(turn_between(above.azimuth, below.azimuth), 1e-6) << "spin " << spin;
        EXPECT_NEAR(above.delay, below.delay, 1e-6) << "spin " << spin;
      }
    }
    EXPECT_GT(seen, 0) << "spin " << spin;
  }
}

//! Returns the first crossing of the disk's plane, computed in precision S; u is 0 if there is
//! none.
template <class S>
EquatorialCrossing<S> first_crossing_in(const CameraStation& station, const Vector3<double>& n, S tolerance) {
  const CameraStationOf<S> camera = converted_station<S>(station);
  const Vector3<S> direction = {static_cast<S>(n.x), static_cast<S>(n.y), static_cast<S>(n.z)};
  EquatorialCrossing<S> found[crossing_orders];
  trace_crossings<sizeof(S) == 4 ? 10 : 20, true>(camera.spin, start_near_ray(camera, direction),
                                                  {S(1e-3), tolerance, 300}, true, found);
  return found[0];
}

TEST(CrossingsFromWithin, AreInFloatWhereDoubleHasThemAtAllHeights) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> part(-1.0, 1.0);
  for (const double spin : {0.0, 0.3, -0.9, 0.998}) {
    const double horizon = horizon_radius(Spacetime{spin});
    const double depth = horizon - inner_horizon_radius(Spacetime{spin});
    for (const double height : {-0.5 * depth, -1e-2 * depth, -1e-6, 1e-7, 1e-3}) {
      int crossings = 0;
      for (int i = 0; i < 200; ++i) {
        const CameraStation camera =
            make_camera_station(Spacetime{spin}, horizon + height, 1.5 + 1.3 * part(random), 0.0, ObserverMotion::rain);
        const Vector3<double> n = normalized({part(random), part(random), part(random)});
        const EquatorialCrossing<double> exact = first_crossing_in<double>(camera, n, 1e-15);
        // Skips crossings next to the horizon, where azimuth and time vary faster than float
        // resolves, and crossings far from the hole.
        if (exact.u * 1.05 * horizon > 1.0 || (exact.u > 0.0 && exact.u < 0.02)) {
          continue;
        }
        const EquatorialCrossing<float> found = first_crossing_in<float>(camera, n, 1e-6F);
        EXPECT_EQ(found.u > 0.0F, exact.u > 0.0) << spin << ' ' << height;
        if (exact.u > 0.0) {
          ++crossings;
          EXPECT_NEAR(static_cast<double>(found.u) / exact.u, 1.0, 1e-3) << spin << ' ' << height;
          EXPECT_LT(turn_between(static_cast<double>(std::atan2(found.y, found.x) + found.drag),
                                 std::atan2(exact.y, exact.x) + exact.drag),
                    1e-3)
              << spin << ' ' << height;
          EXPECT_NEAR(static_cast<double>(found.delay), exact.delay, 1e-3 / exact.u) << spin << ' ' << height;
        }
      }
      EXPECT_GT(crossings, 10) << spin << ' ' << height;
    }
  }
}

TEST(CrossingsFromWithin, AreCountedAlikeInBothCoordinatesFromOutside) {
  for (const double spin : {0.0, -0.6, 0.9, 0.9999999}) {
    const CameraStation camera =
        make_camera_station(Spacetime{spin}, 1.15 * horizon_radius(Spacetime{spin}), 1.2, 0.0, ObserverMotion::rain);
    const NearRay<double> ingoing = start_near_ray(camera, normalized({0.4, 0.85, -0.3}));
    ASSERT_TRUE(ingoing.ingoing);
    NearRay<double> usual = ingoing;
    usual.ingoing = false;
    EquatorialCrossing<double> a[crossing_orders];
    EquatorialCrossing<double> b[crossing_orders];
    trace_crossings<20, true>(spin, ingoing, {1e-7, 1e-14, 4000}, true, a);
    trace_crossings<20, true>(spin, usual, {1e-7, 1e-14, 4000}, true, b);
    ASSERT_GT(b[0].u, 0.0) << spin;
    EXPECT_LT(turn_between(std::atan2(a[0].y, a[0].x) + a[0].drag, std::atan2(b[0].y, b[0].x) + b[0].drag), 1e-7)
        << spin;
    EXPECT_NEAR(a[0].delay, b[0].delay, 1e-7) << spin;
  }
}

TEST(CrossingsFromWithin, AreNotThoseOfAnotherUniversesLight) {
  // E (r_+² + a²) - a L is negative. This light was never outside the horizon, although its 1/r has
  // the same solution as that of light which was.
  const double spin = 0.9;
  const CameraStation camera = make_camera_station(Spacetime{spin}, 1.0, 1.2, 0.0, ObserverMotion::rain);
  const NearRay<double> ray = start_near_ray(camera, normalized({-0.9, 0.3, 0.3}));
  ASSERT_LT(2.0 * horizon_radius(Spacetime{spin}) * ray.energy - spin * ray.axial_angular_momentum, 0.0);
  EquatorialCrossing<double> crossings[crossing_orders];
  trace_crossings<20, true>(spin, ray, {1e-7, 1e-15, 4000}, true, crossings);
  EXPECT_EQ(crossings[0].u, 0.0);
}

}  // namespace
}  // namespace ergodome::test
