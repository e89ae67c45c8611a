#pragma once

#include <memory>

#include "content/trajectory/trajectory_journal.h"
#include "render/bake/trajectory_baker.h"
#include "render/eyes/eye_camera.h"
#include "render/lens/grid/screen_error.h"
#include "render/passes/disk/disk_camera.h"
#include "render/passes/disk/disk_pass.h"

namespace ergodome {

//! The disk of a show, as large as it ever is; nothing where it has none whose layers grids can hold.
std::unique_ptr<const DiskPass> disk_to_bake(const Show& show);

//! Bakes the layers of a show's disk beside its lenses.
class DiskBake {
 public:
  DiskBake(const Show& show, const BakeSettings& settings, TrajectoryJournal& journal);

  //! Whether the show has such a disk; without, nothing else may be called.
  [[nodiscard]] bool wanted() const { return disk_ != nullptr; }

  //! Builds the layers at a show time that the journal lacks.
  void add_if_missing(double time_s);

  //! What blending the layers at two times misses by at a quarter, half and three quarters of the way, the worst [px], measured as gaps of lenses are.
  [[nodiscard]] double gap_error(double begin_s, double end_s) const;

 private:
  [[nodiscard]] EyeCamera eye_at(double time_s) const;
  [[nodiscard]] DiskGridSettings settings_at(const EyeCamera& eye) const;

  const Show& show_;
  const BakeSettings& settings_;
  TrajectoryJournal& journal_;
  std::unique_ptr<const DiskPass> disk_;
};

//! Of the bake's budget, for the grid of a station; what blending adds has to fit into the rest.
inline constexpr double baked_grid_share = 0.5;

//! One number from the bounds of an error: what is worse than the budget in a hundredth of the sky is worse than five budgets in a thousandth at
//! most.
double gap_measure(const ScreenError& error);

}  // namespace ergodome
