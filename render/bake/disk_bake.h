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

//! Returns the pass of a show's disk with its animated edges at their maximum; nullptr if the show
//! has no disk, or one that a grid cannot hold.
std::unique_ptr<const DiskPass> disk_to_bake(const Show& show);

//! Bakes the layers of a show's disk along with its lenses.
class DiskBake {
 public:
  DiskBake(const Show& show, const BakeSettings& settings, TrajectoryJournal& journal);

  //! Returns whether the show has a disk that can be baked. If not, no other function may be
  //! called.
  [[nodiscard]] bool wanted() const { return disk_ != nullptr; }

  //! Builds the disk layers at a show time and adds them to the journal, unless it already contains
  //! them.
  void add_if_missing(double time_s);

  //! Returns the error of blending the disk layers of two stations [px], which the journal must
  //! contain: the largest at a quarter, half and three quarters of the gap, measured as for lens
  //! stations (gap_measure()). Returns 0 for stations at the same r and θ, and unknown_disk_error
  //! if the layers cannot be joined.
  [[nodiscard]] double gap_error(double begin_s, double end_s) const;

 private:
  [[nodiscard]] EyeCamera eye_at(double time_s) const;
  [[nodiscard]] DiskGridSettings settings_at(const EyeCamera& eye) const;

  const Show& show_;
  const BakeSettings& settings_;
  TrajectoryJournal& journal_;
  std::unique_ptr<const DiskPass> disk_;
};

//! Fraction of the bake's error budget that the grid of a station may use; the rest is for the
//! error of blending.
inline constexpr double baked_grid_share = 0.5;

//! Combines two quantiles of an error over the sky into one number: the larger of the 99 % quantile
//! and a fifth of the 99.9 % quantile.
double gap_measure(const ScreenError& error);

}  // namespace ergodome
