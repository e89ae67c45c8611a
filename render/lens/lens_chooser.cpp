#include "render/lens/lens_chooser.h"

#include <algorithm>
#include <utility>

#include "render/lens/direct_lens.h"
#include "render/lens/grid_builder.h"

namespace ergodome {

namespace {

//! Both eyes, and both of the moment before.
constexpr std::size_t kept_grids = 4;
//! Below this many pixels a grid is not worth its while; compare dome_frame/direct and dome_frame/live_grid in tests/bench.
constexpr double least_pixels = 150'000.0;
//! Float traces grids well down to this budget [rad].
constexpr double finest_float_budget = 2e-5;

}  // namespace

const LensChooser::Grid& LensChooser::grid_for(const EyeCamera& eye, const Projection& projection, double budget_px) {
  const double pixel = pixel_angle(projection);
  const double error = budget_px * pixel;
  const auto serves = [&](const Grid& grid) {
    // A grid serves any motion, but was refined where its own observer looks closely: the motion may differ, not much.
    const Vector3<double> turn = grid.velocity - eye.velocity;
    return grid.spin == eye.spin && grid.r == eye.r && grid.theta == eye.theta && grid.error <= 1.01 * error &&
           grid.error >= 0.5 * error && grid.motion == eye.motion && dot(turn, turn) < 1e-4;
  };
  const auto found = std::find_if(grids_.begin(), grids_.end(), serves);
  if (found != grids_.end()) {
    grids_.splice(grids_.begin(), grids_, found);
    return grids_.front();
  }
  GridSettings settings;
  settings.pixel = pixel;
  settings.budget_px = budget_px;
  settings.observer = aberration_to_rain(eye.spin, eye.r, eye.theta, eye.motion, eye.velocity);
  settings.fine = error < finest_float_budget;
  GridStatistics statistics;
  LensStation station = build_lens_station(eye.spin, eye.r, eye.theta, settings, &statistics);
  grids_.push_front({eye.spin, eye.r, eye.theta, error, eye.motion, eye.velocity, statistics.flagged_px,
                     std::make_shared<StationBuffers>(backend_, std::move(station))});
  ++built_;
  if (grids_.size() > kept_grids) {
    grids_.pop_back();
  }
  return grids_.front();
}

std::unique_ptr<LensSource> LensChooser::choose(LensChoice choice, const EyeCamera& eye, const Projection& projection,
                                                ViewMode mode, const LensAccuracy& accuracy) {
  const bool about_rays = mode == ViewMode::steps || mode == ViewMode::error_estimate || mode == ViewMode::image_order;
  const double pixels = static_cast<double>(projection.width_px) * projection.height_px;
  // On a GPU rays are cheap, and grids come from the CPU.
  const bool worth_a_grid = backend_ == Backend::cpu && pixels >= least_pixels;
  if (!about_rays && (choice == LensChoice::live || (choice == LensChoice::automatic && worth_a_grid))) {
    const Grid& grid = grid_for(eye, projection, accuracy.budget_px);
    if (choice == LensChoice::live || grid.traced_px < 0.25 * pixels) {
      return std::make_unique<GridLens>(backend_, StationBlend(grid.station), eye, projection, accuracy.tolerance_px);
    }
  }
  return std::make_unique<DirectLens>(backend_, eye, projection, accuracy.tolerance_px);
}

}  // namespace ergodome
