#include "render/passes/disk/streamed_disk.h"

#include <cmath>
#include <utility>

#include "render/passes/disk/disk_grid_error.h"

namespace ergodome {

namespace {

//! Returns whether the disk layers of two stations, or of a single one, can be used for a disk:
//! their edges and pattern suit it (serves_disk()), and blending them is accurate enough.
bool serve(const StationPair& pair, double budget_px, const DiskAppearance& disk) {
  const auto serves = [&](const std::shared_ptr<const DiskStation>& station) {
    return station && serves_disk(station->inner_r, station->outer_r, station->pattern, disk);
  };
  return serves(pair.first_disk) && static_cast<double>(pair.disk_gap_error_px) <= budget_px &&
         (!pair.second || serves(pair.second_disk));
}

//! Returns whether a station is at the head's position. A single station need not be at that
//! position: it may replace another one that could not be read.
bool is_at(const DiskStation& station, const EyeCamera& eye) {
  return std::abs(station.cells.r - eye.head_r) <= 1e-9 * eye.head_r &&
         std::abs(station.cells.theta - eye.head_theta) <= 1e-9;
}

}  // namespace

std::optional<DiskGrid> StreamedDisk::layers_for(const DiskGridRequest& request, LensChoice choice,
                                                 std::optional<double> time_s) {
  layers_.reset();
  const EyeCamera& eye = request.eye;
  if (!stream_ || !time_s || !can_have_disk_grid(request.disk) ||
      !may_stream(stream_->trajectory().provenance(), choice, eye, request.budget_px * request.pixel)) {
    return std::nullopt;
  }
  const TrajectoryProvenance& baked = stream_->trajectory().provenance();
  const std::optional<StationPair> pair = stream_->at_hand(*time_s);
  if (!pair || !serve(*pair, baked.budget_px, request.disk) || (!pair->second && !is_at(*pair->first_disk, eye))) {
    return std::nullopt;
  }
  const LensPosition position = {eye.r, eye.theta};
  blend(*pair, position);
  if (!layers_) {
    return std::nullopt;
  }
  if (is_beside(eye)) {
    const DiskGridSettings settings = disk_grid_settings(eye, request.disk, request.pixel);
    const ScreenError error =
        measure_disk_error(layers_->view(), eye.spacetime, position, settings, lattice_samples(32, 16));
    if (error.p99_px > allowed_unmeasured_px(baked, request.budget_px, request.pixel)) {
      return std::nullopt;
    }
  }
  return layers_->view();
}

void StreamedDisk::blend(const StationPair& pair, const LensPosition& position) {
  if (!pair.second) {
    layers_.emplace(pair.first_disk, position);
    return;
  }
  if (pair.first_disk != first_ || pair.second_disk != second_) {
    first_ = pair.first_disk;
    second_ = pair.second_disk;
    std::optional<JoinedDisk> both = join(*first_, *second_);
    joined_ = both ? std::make_shared<const JoinedDisk>(std::move(*both)) : nullptr;
  }
  if (joined_) {
    layers_.emplace(joined_, position);
  }
}

}  // namespace ergodome
