#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <string>

#include "kernels/core/angles.h"
#include "kernels/core/dual.h"
#include "kernels/spacetime/geodesic/taylor.h"
#include "render/lens/grid/grid_builder.h"
#include "tests/support/lens_errors.h"

namespace ergodome {
namespace {

//! A camera, the motion of its observer, and its lens grid with a budget of 0.1 px of a 4096² dome.
struct GridCase {
  double spin;
  double r;
  double theta;
  ObserverMotion motion = ObserverMotion::zamo;
  Vector3<double> velocity{};
  GridSettings settings{};
  GridStatistics statistics{};
  LensStation station{};

  GridCase(double a, double radius, double polar, ObserverMotion observer = ObserverMotion::zamo)
      : spin(a), r(radius), theta(polar), motion(observer) {
    settings.pixel = pi / 4096.0;
    settings.observer = aberration_to_rain(Spacetime{spin}, r, theta, motion, velocity);
    build();
  }

  void build() { station = build_lens_station(Spacetime{spin}, r, theta, settings, &statistics); }

  [[nodiscard]] CameraStation camera() const {
    return make_camera_station(Spacetime{spin}, r, theta, 0.0, motion, velocity);
  }
};

using test::Errors;
using test::random_rays;
using test::Rays;

//! Returns a lens that is the grid of a single station.
LensBlend lens_of(const LensStation& station) {
  const LensGrid grid = grid_view(station);
  return {grid.chart, {grid, grid}, {}, 0.0F};
}

void read_through(const GridCase& c, Rays& rays) {
  test::read_through(lens_of(c.station), c.camera(), c.settings.observer, rays);
}

//! Returns the errors on the screen for random directions that see the sky. They include directions
//! so close to the shadow that the grid cuts them off, and directions that the lens leaves to
//! tracing.
Errors errors_of(const GridCase& c, std::size_t count = 100'000) {
  return test::screen_errors(lens_of(c.station), c.camera(), c.settings.observer, c.settings.pixel, count);
}

TEST(LensGrid, FastHoleAtFiveHoldsATenthOfAPixelWithFewNodes) {
  const GridCase c(0.999, 5.0, 0.5 * pi);
  EXPECT_LE(c.statistics.nodes, 10'000);
  const Errors errors = errors_of(c);
  EXPECT_LE(errors.at(0.99), 0.1);
  EXPECT_LE(errors.at(0.999), 0.5);
  EXPECT_LE(errors.traced, 0.005);
}

TEST(LensGrid, SlowHoleNeedsAFourthOfTheNodes) {
  const GridCase c(0.5, 5.0, 0.5 * pi);
  EXPECT_LE(c.statistics.nodes, 2500);
  EXPECT_LE(errors_of(c).at(0.99), 0.1);
}

TEST(LensGrid, CloseToAFastHoleHoldsHalfAPixel) {
  const GridCase c(0.999, 1.5, 0.5 * pi);
  EXPECT_LE(c.statistics.nodes, 20'000);
  const Errors errors = errors_of(c);
  EXPECT_LE(errors.at(0.99), 0.5);
  EXPECT_LE(errors.traced, 0.03);
}

TEST(LensGrid, FloatTracedNodesHoldTheSameBudget) {
  GridCase c(0.999, 5.0, 0.5 * pi);
  c.settings.fine = false;
  c.build();
  EXPECT_LE(errors_of(c).at(0.99), 0.1);
}

struct HardCamera {
  double spin;
  double r;
  double theta;
  ObserverMotion motion = ObserverMotion::zamo;
};

//! Positions and motions of cameras for which grids must keep their budget.
class LensGridOfHardCamera : public testing::TestWithParam<HardCamera> {};

TEST_P(LensGridOfHardCamera, HoldsItsBudgetOverTheSky) {
  const HardCamera& camera = GetParam();
  const Errors errors = errors_of(GridCase(camera.spin, camera.r, camera.theta, camera.motion), 20'000);
  EXPECT_LE(errors.at(0.98), 0.1);
  EXPECT_TRUE(std::isfinite(errors.px.back()));
}

INSTANTIATE_TEST_SUITE_P(
    HardCases, LensGridOfHardCamera,
    testing::Values(HardCamera{0.0, 10.0, 1.0}, HardCamera{1.0, 5.0, 0.5 * pi}, HardCamera{-0.9, 4.0, 1.1},
                    HardCamera{0.9, 3.0, 0.0}, HardCamera{0.9, 3.0, 1e-9}, HardCamera{1.0 - 1e-6, 30.0, 2.0},
                    HardCamera{0.7, 1e6, 1.0}, HardCamera{0.95, 1.45, 0.8},
                    HardCamera{0.999, 5.0, 0.5 * pi, ObserverMotion::geodesic},
                    HardCamera{0.999, 6.0, 0.5 * pi, ObserverMotion::retrograde},
                    HardCamera{0.5, 8.0, 2.0, ObserverMotion::rain}, HardCamera{0.0, 3.0, 0.5 * pi},
                    HardCamera{0.5, 8.0, 0.6, ObserverMotion::fixed}),
    [](const testing::TestParamInfo<HardCamera>& each) { return "Camera" + std::to_string(each.index); });

TEST(LensGrid, MirroredHalfIsTheWholeSky) {
  // A camera slightly off the equator needs a whole grid, but sees nearly the same as one on the
  // equator.
  const GridCase half(0.9, 6.0, 0.5 * pi);
  const GridCase whole(0.9, 6.0, 0.5 * pi - 1e-7);
  ASSERT_TRUE(half.station.mirrored);
  ASSERT_FALSE(whole.station.mirrored);
  EXPECT_LT(half.statistics.nodes, 0.6 * whole.statistics.nodes);
  Rays a = random_rays(5000, 2);
  Rays b = a;
  read_through(half, a);
  read_through(whole, b);
  std::vector<double> difference;
  for (std::size_t i = 0; i < a.status.size(); ++i) {
    if (a.status[i] == 0.0 && b.status[i] == 0.0) {
      difference.push_back(std::hypot(a.sky[0][i] - b.sky[0][i], a.sky[1][i] - b.sky[1][i], a.sky[2][i] - b.sky[2][i]));
    }
  }
  std::sort(difference.begin(), difference.end());
  EXPECT_LT(difference[difference.size() * 95 / 100], 2e-4);
}

//! Returns the sky direction at chart coordinates (γ, s) and its derivatives along them,
//! interpolated in the bicubic patches of a grid.
GridSky<double> at(const LensStation& station, double gamma_turns, double s) {
  ChartPosition<Dual<double>> position{};
  position.gamma_turns = {gamma_turns, 1.0, 0.0};
  position.s = {s, 0.0, 1.0};
  return read_grid(grid_view(station), position);
}

TEST(LensGrid, ValueAndDerivativesAreContinuousAcrossEveryKindOfCellSide) {
  const GridCase c(0.999, 5.0, 1.0);
  const float unit = 1.0F / (16.0F * 64.0F);
  double worst_value = 0.0;
  double worst_slope = 0.0;
  int across_levels = 0;
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> uniform;
  for (int i = 0; i < 20'000; ++i) {
    // Chooses a line of the finest lattice of cell sides, and a random position on it, where it is
    // crossed.
    const double line = std::floor(uniform(random) * 1024.0) * static_cast<double>(unit);
    const double s = 0.3 + 0.7 * uniform(random);
    const double step = 1e-7;
    const Leaf before = find_leaf(grid_view(c.station), static_cast<float>(line) - 1e-6F, static_cast<float>(s));
    const Leaf after = find_leaf(grid_view(c.station), static_cast<float>(line) + 1e-6F, static_cast<float>(s));
    if (before.number == after.number || before.flagged || after.flagged || line <= 0.0) {
      continue;
    }
    across_levels += before.height != after.height ? 1 : 0;
    const GridSky<double> a = at(c.station, line - step, s);
    const GridSky<double> b = at(c.station, line + step, s);
    const double slope = std::abs(a.sky.x.along_x) + std::abs(a.sky.y.along_x) + std::abs(a.sky.z.along_x) +
                         std::abs(a.sky.x.along_y) + std::abs(a.sky.y.along_y) + std::abs(a.sky.z.along_y);
    worst_value = std::max(worst_value, std::abs(a.sky.x.value - b.sky.x.value) / (1.0 + slope));
    worst_slope = std::max({worst_slope, std::abs(a.sky.x.along_x - b.sky.x.along_x) / (1.0 + slope),
                            std::abs(a.sky.z.along_y - b.sky.z.along_y) / (1.0 + slope)});
  }
  EXPECT_GT(across_levels, 50);
  EXPECT_LT(worst_value, 1e-5);
  EXPECT_LT(worst_slope, 2e-3);
}

TEST(LensGrid, MagnificationMatchesTheExactOneAwayFromFlaggedCells) {
  const GridCase c(0.9, 8.0, 1.2);
  Rays rays = random_rays(4000, 5);
  read_through(c, rays);
  const CameraStation camera = c.camera();
  const LensGrid grid = grid_view(c.station);
  std::vector<double> relative;
  for (std::size_t i = 0; i < rays.status.size(); ++i) {
    if (rays.status[i] != 0.0 || rays.steps[i] > 0.0) {
      continue;
    }
    using D = Dual<double>;
    const Vector3<double> n = {rays.n[0][i], rays.n[1][i], rays.n[2][i]};
    const Vector3<double> aside = std::abs(n.x) < 0.7 ? Vector3<double>{1.0, 0.0, 0.0} : Vector3<double>{0.0, 1.0, 0.0};
    const Vector3<double> e1 = normalized(cross(n, aside));
    const Vector3<double> e2 = cross(n, e1);
    const Vector3<D> seeded = {D(n.x, e1.x, e2.x), D(n.y, e1.y, e2.y), D(n.z, e1.z, e2.z)};
    const auto area = [](const Vector3<D>& sky) {
      const Vector3<double> normal = cross(Vector3<double>{sky.x.along_x, sky.y.along_x, sky.z.along_x},
                                           Vector3<double>{sky.x.along_y, sky.y.along_y, sky.z.along_y});
      return std::sqrt(dot(normal, normal));
    };
    double steps = 0.0;
    bool reached = false;
    const double exact =
        area(trace_taylor<20>(camera.spin, start_ray(camera, seeded), true, {1e-13, 5000}, steps, reached).sky);
    const double read =
        area(read_grid(grid, chart_position(grid.chart, rain_direction(c.settings.observer, seeded))).sky);
    relative.push_back(std::abs(read / exact - 1.0));
  }
  std::sort(relative.begin(), relative.end());
  EXPECT_LT(relative[relative.size() / 2], 1e-3);
  EXPECT_LT(relative[relative.size() * 95 / 100], 2e-2);
}

TEST(LensGrid, TwoBuildsAreTheSameToTheBit) {
  const GridCase a(0.999, 5.0, 1.3);
  const GridCase b(0.999, 5.0, 1.3);
  EXPECT_EQ(a.station.nodes, b.station.nodes);
  EXPECT_EQ(a.station.tree, b.station.tree);
  EXPECT_EQ(a.station.leaves, b.station.leaves);
}

TEST(LensGrid, NodeLimitLeavesTheRestToRays) {
  GridCase c(1.0, 30.0, 0.5 * pi);
  c.r = 1.01;
  c.settings.observer = aberration_to_rain(Spacetime{c.spin}, c.r, c.theta, c.motion, {});
  c.settings.max_nodes = 2000;
  c.build();
  EXPECT_LE(c.statistics.nodes, 8000);
  EXPECT_GT(c.statistics.flagged_leaves, 0);
}

}  // namespace
}  // namespace ergodome
