#pragma once

#include <memory>

#include "content/trajectory/trajectory_journal.h"
#include "render/bake/trajectory_baker.h"
#include "render/eyes/eye_camera.h"
#include "render/lens/grid/screen_error.h"
#include "render/passes/disk/disk_camera.h"
#include "render/passes/disk/disk_pass.h"

// Bakes the layers of a show's disk.

namespace ergodome {

//! Returns the disk of a show at its largest; nothing without a disk whose layers a grid can hold.
std::unique_ptr<const DiskPass> disk_to_bake(const Show& show);

//! Bakes the layers of a show's disk along with its lenses.
class DiskBake {
 public:
  DiskBake(const Show& show, const BakeSettings& settings, TrajectoryJournal& journal);

  //! Returns whether the show has such a disk. If not, no other function may be called.
  [[nodiscard]] bool wanted() const { return disk_ != nullptr; }

  //! Builds the layers at a show time unless the journal has them.
  void add_if_missing(double time_s);

  //! Returns the largest error of blending the layers at two times [px], at a quarter, half and
  //! three quarters of the gap. Measured like gaps of lenses.
  [[nodiscard]] double gap_error(double begin_s, double end_s) const;

 private:
  [[nodiscard]] EyeCamera eye_at(double time_s) const;
  [[nodiscard]] DiskGridSettings settings_at(const EyeCamera& eye) const;

  const Show& show_;
  const BakeSettings& settings_;
  TrajectoryJournal& journal_;
  std::unique_ptr<const DiskPass> disk_;
};

//! Share of the bake's budget for the grid of a station; the rest is for blending.
inline constexpr double baked_grid_share = 0.5;

//! Combines the quantiles of an error into one number: the limit for 99.9 % of the sky is five
//! times that for 99 %.
double gap_measure(const ScreenError& error);

}  // namespace ergodome
