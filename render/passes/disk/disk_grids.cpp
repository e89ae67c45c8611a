#include "render/passes/disk/disk_grids.h"

#include <algorithm>
#include <cmath>

#include "kernels/spacetime/kerr/kerr.h"
#include "render/lens/stations/lens_position.h"

namespace ergodome {

namespace {

//! Number of cached grids: for two eyes, each at the current and the previous position.
constexpr std::size_t kept_disk_grids = 4;
constexpr const char* disk_grid_buffer = "disk grid";

double error_of(const DiskGridRequest& request) { return request.budget_px * request.pixel; }

}  // namespace

DiskGridBuffers::DiskGridBuffers(const DiskStation& station)
    : cells_(grid_view(station.cells)),
      edge_(Backend::cpu, station.cells.edge, disk_grid_buffer),
      tree_(Backend::cpu, station.cells.tree, disk_grid_buffer),
      leaves_(Backend::cpu, station.cells.leaves, disk_grid_buffer),
      orders_(Backend::cpu, station.orders, disk_grid_buffer) {
  for (int set = 0; set < station.sets(); ++set) {
    nodes_[set] = Buffer<float>(Backend::cpu, station.nodes[set], disk_grid_buffer);
  }
  if (!station.nearness.empty()) {
    nearness_ = Buffer<float>(Backend::cpu, station.nearness, disk_grid_buffer);
  }
}

DiskGrid DiskGridBuffers::view() const {
  DiskGrid grid{cells_,
                {nodes_[0].data(), nodes_[1].data(), nodes_[2].data()},
                orders_.data(),
                nearness_.size() > 0 ? nearness_.data() : nullptr};
  grid.cells.chart.edge.polar_angle = edge_.data();
  grid.cells.tree = tree_.data();
  grid.cells.leaves = leaves_.data();
  grid.cells.nodes = nullptr;
  return grid;
}

bool can_have_disk_grid(const DiskAppearance& disk) {
  return disk.outer_r > disk.inner_r && disk.inner_r >= 0.999999F * disk.flow.stable_r;
}

bool serves_disk(double inner_r, double outer_r, bool pattern, const DiskAppearance& disk) {
  const auto wanted_r = static_cast<double>(disk.outer_r);
  return inner_r == static_cast<double>(disk.inner_r) && outer_r >= wanted_r && outer_r <= 1.5 * wanted_r &&
         pattern == has_pattern(disk);
}

DiskGridSettings disk_grid_settings(const EyeCamera& eye, const DiskAppearance& disk, double pixel) {
  DiskGridSettings settings;
  settings.inner_r = static_cast<double>(disk.inner_r);
  settings.outer_r = static_cast<double>(disk.outer_r);
  settings.pattern = has_pattern(disk);
  settings.pixel = pixel;
  settings.observer = aberration_to_rain(eye.spacetime, eye.r, eye.theta, eye.motion, eye.velocity);
  return settings;
}

bool DiskGrids::serves(const Grid& grid, const DiskGridRequest& request) {
  const EyeCamera& eye = request.eye;
  // A grid is correct for any velocity, but its cells are refined for the observer for which it was
  // built, so the velocity may differ only slightly.
  const Vector3<double> turn = grid.velocity - eye.velocity;
  return grid.spacetime == eye.spacetime && same_position({grid.r, grid.theta}, {eye.r, eye.theta}) &&
         serves_disk(grid.inner_r, grid.outer_r, grid.pattern, request.disk) &&
         grid.error <= 1.01 * error_of(request) && grid.error >= 0.5 * error_of(request) && grid.motion == eye.motion &&
         grid.nearness == request.nearness && dot(turn, turn) < 1e-4;
}

DiskGrids::Grid DiskGrids::make(const DiskGridRequest& request) {
  const EyeCamera& eye = request.eye;
  DiskGridSettings settings = disk_grid_settings(eye, request.disk, request.pixel);
  settings.budget_px = request.budget_px;
  settings.nearness = request.nearness;
  GridStatistics statistics;
  const DiskStation station = build_disk_station(eye.spacetime, eye.r, eye.theta, settings, &statistics, &tracer_);
  ++built_;
  return {
      eye.spacetime,     eye.r,      eye.theta,    settings.inner_r, settings.outer_r,      settings.pattern,
      error_of(request), eye.motion, eye.velocity, request.nearness, statistics.flagged_px, DiskGridBuffers(station)};
}

std::optional<DiskGrid> DiskGrids::grid_for(const DiskGridRequest& request) {
  if (!can_have_disk_grid(request.disk) || (!request.asked && !is_worth_a_disk_grid(Backend::cpu, request.pixels))) {
    return std::nullopt;
  }
  auto found = std::find_if(grids_.begin(), grids_.end(), [&](const Grid& grid) { return serves(grid, request); });
  if (found == grids_.end()) {
    grids_.push_front(make(request));
    if (grids_.size() > kept_disk_grids) {
      grids_.pop_back();
    }
    found = grids_.begin();
  } else {
    grids_.splice(grids_.begin(), grids_, found);
  }
  if (!request.asked && found->traced_px >= 0.25 * request.pixels) {
    return std::nullopt;
  }
  return found->buffers.view();
}

}  // namespace ergodome
