#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include "kernels/core/angles.h"
#include "kernels/disk/disk_chart.h"
#include "kernels/disk/disk_light.h"
#include "kernels/disk/equatorial_crossings.h"
#include "kernels/spacetime/kerr/horizon_winding.h"
#include "kernels/spacetime/shadow/shadow_chart.h"
#include "render/passes/disk/disk_grids.h"
#include "tests/kernels/reference_tables.h"
#include "tests/support/sanitized.h"

namespace ergodome {
namespace {

constexpr double table_budget_px = 0.1;
constexpr double table_pixel = 1e-3;

//! A crossing of the disk's plane, interpolated in a grid. Derivatives are along two perpendicular
//! directions of the observer's sky, per pixel.
struct ReadCrossing {
  //! True if the grid is accurate here; otherwise the pixel is left to rays.
  bool good = false;
  bool shown = false;
  Dual<double> u;
  Dual<double> azimuth;
  Dual<double> delay;
};

//! Returns a direction with its derivatives along two perpendicular directions, per pixel.
Vector3<Dual<float>> spread(const Vector3<double>& n, double pixel) {
  const Vector3<double> aside = std::abs(n.x) < 0.7 ? Vector3<double>{1.0, 0.0, 0.0} : Vector3<double>{0.0, 1.0, 0.0};
  const Vector3<double> first = normalized(cross(n, aside));
  const Vector3<double> second = cross(n, first);
  const auto part = [&](double v, double a, double b) {
    return Dual<float>{static_cast<float>(v), static_cast<float>(pixel * a), static_cast<float>(pixel * b)};
  };
  return {part(n.x, first.x, second.x), part(n.y, first.y, second.y), part(n.z, first.z, second.z)};
}

ReadCrossing read_crossing(const DiskStation& station, const Aberration& observer, const Vector3<double>& n,
                           double pixel, int order) {
  const LensGrid cells = grid_view(station.cells);
  const Vector3<Dual<float>> in_rain = rain_direction(converted_aberration<float>(observer), spread(n, pixel));
  const DiskPosition<float> position = disk_position(cells.chart.edge, in_rain);
  const bool over = station.cells.mirrored && position.gamma_turns.value > 0.5F;
  const float turns = over ? 1.0F - position.gamma_turns.value : position.gamma_turns.value;
  const Leaf leaf = find_leaf(cells, turns, position.s.value);
  const LeafPosition at = position_in(leaf, turns, position.s.value);
  const auto set = static_cast<std::size_t>(station.pattern ? order : 0);
  const PatchValue value =
      patch_value(station.nodes[set].data(), cells.leaves + 4 * leaf.number, at.u, at.v, leaf.width_turns, leaf.height);
  const auto dual = [&](int part) {
    const float side = over ? -1.0F : 1.0F;
    const float by_gamma = side * quad_part(value.along_gamma, part);
    const float by_s = quad_part(value.along_s, part);
    return Dual<double>{static_cast<double>(quad_part(value.sky, part)),
                        static_cast<double>(by_gamma * position.gamma_turns.along_x + by_s * position.s.along_x),
                        static_cast<double>(by_gamma * position.gamma_turns.along_y + by_s * position.s.along_y)};
  };
  ReadCrossing read;
  read.good = !leaf.flagged;
  read.shown = (station.orders[static_cast<std::size_t>(leaf.number)] >> static_cast<unsigned>(order) & 1U) != 0U;
  read.u = dual(station.pattern ? 0 : order);
  if (station.pattern) {
    const HorizonWinding<double> horizon = horizon_winding(station.cells.spacetime.spin);
    const double rate = winding_rate(horizon, read.u.value);
    const Dual<double> wound = {winding(horizon, read.u.value), rate * read.u.along_x, rate * read.u.along_y};
    const Dual<double> cosine = dual(1);
    const Dual<double> sine = dual(2);
    const double square = cosine.value * cosine.value + sine.value * sine.value;
    const Dual<double> turn = {std::atan2(sine.value, cosine.value),
                               (cosine.value * sine.along_x - sine.value * cosine.along_x) / square,
                               (cosine.value * sine.along_y - sine.value * cosine.along_y) / square};
    read.azimuth = turn + wound * winding_turn(horizon);
    read.delay = dual(3) + wound * winding_delay(horizon);
  }
  return read;
}

double change_of(const Dual<double>& a) { return std::hypot(a.along_x, a.along_y); }

//! Returns the grid, with the pattern's channels, of a disk that starts at the innermost stable
//! orbit.
DiskStation station_for(double spin, double r, double theta, const Aberration& observer, double outer_r, double pixel) {
  DiskGridSettings settings;
  settings.inner_r = innermost_stable_radius(Spacetime{spin}, 1.0);
  settings.outer_r = outer_r;
  settings.pattern = true;
  settings.pixel = pixel;
  settings.budget_px = table_budget_px;
  settings.observer = observer;
  return build_disk_station(Spacetime{spin}, r, theta, settings);
}

//! A crossing of the reference table, and the same crossing in a grid that is built for the row's
//! camera.
struct TableReading {
  test::ReferenceCrossing row;
  ReadCrossing read;
};

//! Interpolates the crossings of the table in grids, except those that the grids leave to rays.
std::vector<TableReading> read_table() {
  std::vector<TableReading> readings;
  DiskStation station;
  for (const test::ReferenceCrossing& row : test::reference_crossings()) {
    const Aberration observer = aberration_to_rain(Spacetime{row.a}, row.r, row.theta, row.motion, row.beta);
    if (station.cells.spacetime.spin != row.a || station.cells.r != row.r || station.cells.theta != row.theta ||
        station.cells.tree.empty()) {
      station = station_for(row.a, row.r, row.theta, observer, 20.0, table_pixel);
    }
    const ReadCrossing read = read_crossing(station, observer, row.n, table_pixel, row.order);
    if (read.good) {
      readings.push_back({row, read});
    }
  }
  return readings;
}

//! Caches the readings, because the grids take seconds.
const std::vector<TableReading>& table_readings() {
  static const std::vector<TableReading> readings = read_table();
  return readings;
}

TEST(DiskGrid, HasTheReferenceCrossingsWithinItsBudget) {
  EXPECT_GT(table_readings().size(), 110U);
  for (const auto& [row, read] : table_readings()) {
    EXPECT_TRUE(read.shown) << row.id;
    EXPECT_LT(std::abs(read.u.value - 1.0 / row.r_hit), table_budget_px * change_of(read.u) + 1e-6) << row.id;
    // The pattern rotates with the flow, so errors of azimuth and of the light's delay combine: the
    // pattern has moved on by rotation times delay.
    const double rotation = 1.0 / (row.r_hit * std::sqrt(row.r_hit) + row.a);
    const double turned =
        std::remainder(read.azimuth.value - row.phi_hit, 2.0 * pi) + rotation * (read.delay.value - row.delay);
    const Dual<double> phase = read.azimuth + read.delay * rotation;
    EXPECT_LT(std::abs(turned), table_budget_px * change_of(phase) + 2e-5) << row.id;
  }
}

TEST(DiskGrid, HasTheReferenceShiftWithinItsBudget) {
  for (const TableReading& reading : table_readings()) {
    const test::ReferenceCrossing& row = reading.row;
    const ReadCrossing& read = reading.read;
    const NearRay<double> ray = start_near_ray(test::station_of(row), row.n);
    const auto ratio = [&](double u) {
      return 1.0 /
             circular_frequency(row.a, {1.0 / u, ray.energy, ray.axial_angular_momentum, ray.shear_constant, true});
    };
    // The frequency ratio may differ by as much as it changes when the radius is displaced by the
    // budget.
    const double allowed = std::abs(ratio(read.u.value + table_budget_px * change_of(read.u)) - ratio(read.u.value));
    EXPECT_NEAR(ratio(read.u.value), row.g_kepler, allowed + 1e-5) << row.id;
  }
}

//! A camera and the disk that it sees.
struct DiskCase {
  double spin;
  double r;
  double theta;
  double outer_r = 20.0;
  ObserverMotion motion = ObserverMotion::zamo;

  //! Returns the angle of a pixel for which the disk has a realistic size in pictures [rad].
  [[nodiscard]] double pixel() const { return std::min(table_pixel, 2.0 * outer_r / r / 500.0); }
};

const std::vector<DiskCase>& disk_cases() {
  static const std::vector<DiskCase> all = {{0.0, 30.0, 1.4},
                                            {0.9, 30.0, 1.4},
                                            {0.999, 30.0, 1.4},
                                            {1.0, 30.0, 1.4},
                                            {-1.0, 30.0, 1.4},
                                            {0.9, 30.0, 0.5 * pi},
                                            {0.9, 30.0, 1.56},
                                            {0.9, 30.0, 0.0},
                                            {0.9, 30.0, 1e-9},
                                            {0.9, 1e3, 1.4},
                                            {0.0, 1e3, 0.5 * pi - 0.05},
                                            {0.9, 8.0, 1.2},
                                            {0.9, 1.5, 1.2},
                                            {0.999, 1.2, 1.3, 10.0},
                                            {0.5, 12.0, 2.4}};
  return all;
}

//! Result of comparing a grid with exact rays, in random directions in which the disk is visible.
struct Comparison {
  int seen[layer_orders] = {0, 0, 0};
  int missed = 0;  //!< number of crossings of the disk in leaves that are marked as empty
  int left = 0;    //!< number of crossings that the grid leaves to rays
  std::vector<double> radius_px;
  std::vector<double> phase_px;
};

Comparison compare_with_rays(const DiskCase& at, const DiskStation& station, const Aberration& observer) {
  const CameraStation camera = make_camera_station(Spacetime{at.spin}, at.r, at.theta, 0.0, at.motion);
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  // Directions cover a square on the sky that is about as wide as the disk with its images appears.
  const double wide = std::min(1.0, 2.0 * at.outer_r / at.r);
  Comparison found;
  for (int i = 0; i < (test::sanitized ? 2000 : 8000); ++i) {
    const Vector3<double> n = at.r > at.outer_r
                                  ? normalized(Vector3<double>{-1.0, wide * unit(random), wide * unit(random)})
                                  : normalized(Vector3<double>{unit(random), unit(random), unit(random)});
    const NearRay<double> ray = start_near_ray(camera, n);
    EquatorialCrossing<double> crossings[crossing_orders];
    trace_crossings<16, true>(at.spin, ray, {0.25 / at.outer_r, 1e-12, 2000}, true, crossings);
    for (int order = 0; order < layer_orders; ++order) {
      const double r = crossings[order].u > 0.0 ? 1.0 / crossings[order].u : 0.0;
      if (!(r > station.inner_r && r < at.outer_r)) {
        continue;
      }
      ++found.seen[order];
      const ReadCrossing read = read_crossing(station, observer, n, at.pixel(), order);
      found.missed += read.shown ? 0 : 1;
      if (!read.good) {
        ++found.left;
        continue;
      }
      // Errors are converted to pixels by dividing by the change per pixel. If hardly anything
      // changes across pixels, a minimum replaces this change.
      const double flat = 1e-4 * (1.0 / station.inner_r - 1.0 / at.outer_r);
      found.radius_px.push_back(std::abs(read.u.value - crossings[order].u) / std::max(change_of(read.u), flat));
      const double rotation = 1.0 / (r * std::sqrt(r) + at.spin);
      const double azimuth = std::atan2(crossings[order].y, crossings[order].x) + crossings[order].drag;
      const double turned = std::remainder(read.azimuth.value - azimuth, 2.0 * pi) +
                            rotation * (read.delay.value - crossings[order].delay);
      const double change = change_of(read.azimuth + read.delay * rotation);
      found.phase_px.push_back(std::abs(turned) / std::max(change, 1e-4));
    }
  }
  return found;
}

double share(std::vector<double> values, double part) {
  const auto at = values.begin() + static_cast<long>(part * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), at, values.end());
  return *at;
}

TEST(DiskGrid, IsHalfForACameraOnTheEquatorAndHasTheOtherHalfToo) {
  const Aberration observer = aberration_to_rain(Spacetime{0.9}, 30.0, 0.5 * pi, ObserverMotion::zamo, {});
  const DiskStation station = station_for(0.9, 30.0, 0.5 * pi, observer, 20.0, table_pixel);
  EXPECT_TRUE(station.cells.mirrored);
  for (const double across : {-0.3, 0.1, 0.4}) {
    const Vector3<double> above = normalized(Vector3<double>{-1.0, -0.2, across});
    const ReadCrossing one = read_crossing(station, observer, above, table_pixel, 0);
    const ReadCrossing other = read_crossing(station, observer, {above.x, -above.y, above.z}, table_pixel, 0);
    EXPECT_NEAR(one.u.value, other.u.value, 1e-5);
    EXPECT_NEAR(one.delay.value, other.delay.value, 1e-3);
  }
}

TEST(DiskGrid, HoldsNoAzimuthAndTimeWithoutAPattern) {
  DiskGridSettings settings;
  settings.observer = aberration_to_rain(Spacetime{0.5}, 30.0, 1.2, ObserverMotion::zamo, {});
  const DiskStation station = build_disk_station(Spacetime{0.5}, 30.0, 1.2, settings);
  EXPECT_EQ(station.sets(), 1);
  EXPECT_GT(station.nodes[0].size(), 0U);
  EXPECT_TRUE(station.nodes[1].empty() && station.nodes[2].empty());
}

TEST(DiskGrid, KeepsItsBudgetAtEveryPlace) {
  // Under sanitizers, a quarter of the cameras is enough to cover the same code.
  constexpr std::size_t stride = test::sanitized ? 4 : 1;
  for (std::size_t i = 0; i < disk_cases().size(); i += stride) {
    const DiskCase& at = disk_cases()[i];
    SCOPED_TRACE(testing::Message() << "a " << at.spin << " r " << at.r << " theta " << at.theta);
    const Aberration observer = aberration_to_rain(Spacetime{at.spin}, at.r, at.theta, at.motion, {});
    const DiskStation station = station_for(at.spin, at.r, at.theta, observer, at.outer_r, at.pixel());
    const Comparison found = compare_with_rays(at, station, observer);
    ASSERT_GT(found.radius_px.size(), test::sanitized ? 50U : 100U);
    EXPECT_EQ(found.missed, 0);
    EXPECT_LT(share(found.radius_px, 0.99), table_budget_px);
    EXPECT_LT(share(found.phase_px, 0.99), table_budget_px);
    EXPECT_LT(share(found.radius_px, 1.0), 2.0 * table_budget_px);
    EXPECT_LT(share(found.phase_px, 1.0), 2.0 * table_budget_px);
    EXPECT_LT(found.left, found.seen[0] / 5);
  }
}

}  // namespace
}  // namespace ergodome
