#include "render/lens/omni_chooser.h"

#include <algorithm>
#include <utility>

#include "kernels/projection/pixel_measure.h"
#include "render/lens/lens_source.h"

namespace ergodome {

namespace {

//! Number of cached grids: one for each eye.
constexpr std::size_t kept_omni_grids = 2;
//! Minimum area of split cells. It is smaller than for a single camera, so that fewer pixels next
//! to the shadow are left to rays.
constexpr double min_cell_px = 8.0;

}  // namespace

const OmniChooser::Grid& OmniChooser::grid_for(const std::shared_ptr<const OmniEye>& eye,
                                               const GridSettings& settings) {
  const double error = settings.budget_px * settings.pixel;
  const auto found = std::ranges::find_if(grids_, [&](const Grid& grid) {
    return grid.error <= 1.01 * error && grid.error >= 0.5 * error && see_alike(*grid.eye, *eye);
  });
  if (found != grids_.end()) {
    std::rotate(grids_.begin(), found, found + 1);
    return grids_.front();
  }
  GridStatistics statistics;
  LensStation station = build_omni_station(*eye, settings, &statistics);
  grids_.insert(grids_.begin(), {eye, error, statistics.flagged_px,
                                 std::make_shared<const StationBuffers>(Backend::cpu, std::move(station))});
  grids_.resize(std::min(grids_.size(), kept_omni_grids));
  return grids_.front();
}

std::unique_ptr<LensSource> OmniChooser::choose(const std::shared_ptr<const OmniEye>& eye, const Projection& projection,
                                                ViewMode mode, LensChoice choice, const LensAccuracy& accuracy) {
  GridSettings settings;
  settings.pixel = pixel_angle(projection);
  settings.budget_px = std::max(std::min(accuracy.budget_px, omni_budget_px), finest_float_budget / settings.pixel);
  settings.fine = false;
  settings.min_area_px = min_cell_px;
  const double pixels = static_cast<double>(projection.width_px) * projection.height_px;
  const bool asked = choice == LensChoice::live || choice == LensChoice::streamed;
  const bool worth_it = is_worth_a_grid(backend_, pixels, true) && settings.budget_px <= accuracy.budget_px;
  if (backend_ == Backend::cpu && choice != LensChoice::direct && !shows_rays(mode) && (asked || worth_it)) {
    const Grid& grid = grid_for(eye, settings);
    if (asked || grid.traced_px < 0.25 * pixels) {
      return std::make_unique<OmniGridLens>(eye, grid.station, projection, accuracy.tolerance_px);
    }
  }
  return std::make_unique<OmniLens>(backend_, eye, projection, accuracy.tolerance_px);
}

}  // namespace ergodome
