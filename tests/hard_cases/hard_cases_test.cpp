#include <gtest/gtest.h>

#include "tests/hard_cases/miss.h"
#include "tests/support/sanitized.h"

// Checks every case of the list (case_list.cpp) with every method of tracing a ray and every source
// of a lens.
namespace ergodome::test {
namespace {

enum class Family { double_ray, float_ray, live_grid, streamed, quadtree };

//! A way to compute what a ray sees. `coarser`: factor on the allowed error, for methods with a
//! coarser tolerance. It applies to the error on the sky for rays in double, and on the screen for
//! rays in float.
struct Method {
  const char* name;
  Family family;
  SeenSky (*see)(const CameraState& camera_state, const Directions& rays);
  double coarser;
};

const Method methods[] = {
    {"Taylor", Family::double_ray,
     [](const CameraState& p, const Directions& n) { return by_rays(p, n, TraceMethod::taylor, 1e-12); }, 1.0},
    {"CashKarp", Family::double_ray,
     [](const CameraState& p, const Directions& n) { return by_rays(p, n, TraceMethod::cash_karp, 1e-9); }, 1e3},
    {"RungeKutta34", Family::double_ray,
     [](const CameraState& p, const Directions& n) { return by_rays(p, n, TraceMethod::rk34, 1e-7); }, 2e5},
    {"TaylorInFloat", Family::float_ray,
     [](const CameraState& p, const Directions& n) { return by_float_rays(p, n, TraceMethod::taylor, 1e-6); }, 1.0},
    {"CashKarpInFloat", Family::float_ray,
     [](const CameraState& p, const Directions& n) { return by_float_rays(p, n, TraceMethod::cash_karp, 1e-5); }, 10.0},
    {"RungeKutta34InFloat", Family::float_ray,
     [](const CameraState& p, const Directions& n) { return by_float_rays(p, n, TraceMethod::rk34, 1e-5); }, 50.0},
    {"LiveGrid", Family::live_grid,
     [](const CameraState& p, const Directions& n) { return by_live_grid(p, n, Nodes::in_double); }, 1.0},
    {"LiveGridInFloat", Family::live_grid,
     [](const CameraState& p, const Directions& n) { return by_live_grid(p, n, Nodes::in_float); }, 1.0},
    {"StreamedStations", Family::streamed, by_streamed_stations, 1.0},
    {"Quadtree", Family::quadtree, by_quadtree, 1.0},
};

void expect_double_rays(const Misses& misses, const HardCase& hard, double coarser) {
  EXPECT_LE(misses.sky, coarser * hard.allowed.sky);
  // The Taylor series must resolve every ray. The other methods (with `coarser` > 1) may run out of
  // steps next to the edge of the shadow, where their error estimates lose all digits.
  EXPECT_LE(coarser > 1.0 ? 0 : misses.unresolved, 0);
}

//! Under sanitizers, grids are built with a budget that is ten times as large. There are so few
//! rays that the 99th percentile is the maximum, so limits are much larger.
constexpr double grid_scale = sanitized ? 2000.0 : 1.0;
constexpr double few_rays = sanitized ? 100.0 : 1.0;

//! Returns the limit of a case for the methods of a family.
double limit_of(const Allowed& allowed, Family family) {
  switch (family) {
    case Family::double_ray:
      return allowed.sky;
    case Family::float_ray:
      return allowed.float_ray;
    case Family::live_grid:
      return allowed.grid_px;
    case Family::streamed:
      return allowed.streamed_px;
    case Family::quadtree:
      break;
  }
  return allowed.quadtree_px;
}

void expect_allowed(const HardCase& hard, const Method& method, const Misses& misses) {
  const double limit = limit_of(hard.allowed, method.family);
  EXPECT_EQ(misses.improper, 0) << "neither a unit vector nor none";
  if (limit >= unbounded || (sanitized && method.family == Family::quadtree)) {
    return;
  }
  EXPECT_LE(misses.wrong, method.family == Family::quadtree ? 3 : 0)
      << "light where it is dark, or none where it is not";
  switch (method.family) {
    case Family::double_ray:
      return expect_double_rays(misses, hard, method.coarser);
    case Family::float_ray:
      EXPECT_EQ(misses.unresolved, 0);
      EXPECT_LE(misses.screen_at(0.99), few_rays * method.coarser * limit) << "rad on the screen";
      return;
    case Family::quadtree:
      EXPECT_LE(misses.screen_at(0.75) / dome_pixel, limit) << "px";
      return;
    case Family::live_grid:
    case Family::streamed:
      EXPECT_EQ(misses.unresolved, 0);
      EXPECT_LE(misses.screen_at(0.99) / dome_pixel, grid_scale * limit) << "px";
      return;
  }
}

class HardCases : public testing::TestWithParam<HardCase> {};

TEST_P(HardCases, AreMetByEveryMethodWithinWhatTheRowAllowsOrToldOf) {
  const HardCase& hard = GetParam();
  const Directions rays = hard.rays(station_at(hard.camera_state));
  const std::vector<ExactRay> exact = exact_rays(station_at(hard.camera_state), rays);
  SCOPED_TRACE(hard.why);
  for (const Method& method : methods) {
    if (limit_of(hard.allowed, method.family) != not_asked) {
      SCOPED_TRACE(method.name);
      expect_allowed(hard, method, misses_of(exact, method.see(hard.camera_state, rays)));
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Every, HardCases, testing::ValuesIn(hard_cases()),
                         [](const auto& each) { return name_of(each.param); });

}  // namespace
}  // namespace ergodome::test
