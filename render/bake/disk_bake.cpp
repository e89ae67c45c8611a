#include "render/bake/disk_bake.h"

#include <algorithm>
#include <memory>
#include <optional>
#include <utility>

#include "content/camera/camera_path.h"
#include "content/show/animated_show.h"
#include "render/passes/disk/disk_grid_builder.h"
#include "render/passes/disk/disk_grid_error.h"
#include "render/passes/disk/disk_grids.h"
#include "render/passes/disk/disk_layers.h"

namespace ergodome {

namespace {

constexpr double far_off = 5.0;

}  // namespace

double gap_measure(const ScreenError& error) { return std::max(error.p99_px, error.p999_px / far_off); }

std::unique_ptr<const DiskPass> disk_to_bake(const Show& show) {
  if (!show.disk) {
    return nullptr;
  }
  // If an edge of the disk moves, the disk is baked with its maximum size; the grid can also be
  // used for a slightly smaller disk.
  auto disk = std::make_unique<const DiskPass>(show_at_most(show), Backend::cpu);
  return can_have_disk_grid(disk->look_at(0.0)) ? std::move(disk) : nullptr;
}

DiskBake::DiskBake(const Show& show, const BakeSettings& settings, TrajectoryJournal& journal)
    : show_(show), settings_(settings), journal_(journal), disk_(disk_to_bake(show)) {}

EyeCamera DiskBake::eye_at(double time_s) const { return eye_camera(show_, camera_pose(show_, time_s), 0.0); }

DiskGridSettings DiskBake::settings_at(const EyeCamera& eye) const {
  DiskGridSettings settings = disk_grid_settings(eye, disk_->look_at(0.0), settings_.pixel);
  settings.budget_px = baked_grid_share * settings_.budget_px;
  settings.derivatives = settings_.derivatives;
  return settings;
}

void DiskBake::add_if_missing(double time_s) {
  if (!journal_.has_disk(time_s)) {
    const EyeCamera eye = eye_at(time_s);
    journal_.add(time_s, build_disk_station(eye.spacetime, eye.r, eye.theta, settings_at(eye)));
  }
}

double DiskBake::gap_error(double begin_s, double end_s) const {
  const DiskStation first = journal_.read_disk(begin_s);
  const DiskStation last = journal_.read_disk(end_s);
  if (first.cells.r == last.cells.r && first.cells.theta == last.cells.theta) {
    return 0.0;
  }
  std::optional<JoinedDisk> both = join(first, last);
  if (!both) {
    return static_cast<double>(unknown_disk_error);
  }
  const auto joined = std::make_shared<const JoinedDisk>(std::move(*both));
  double worst_px = 0.0;
  for (const double part : {0.5, 0.25, 0.75}) {
    const EyeCamera eye = eye_at(begin_s + part * (end_s - begin_s));
    const LensPosition position = {eye.r, eye.theta};
    const DiskLayers layers(joined, position);
    worst_px = std::max(worst_px, gap_measure(measure_disk_error(layers.view(), eye.spacetime, position,
                                                                 settings_at(eye), leaf_samples(joined->first.cells))));
  }
  return worst_px;
}

}  // namespace ergodome
