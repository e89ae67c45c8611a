#pragma once

#include <optional>
#include <vector>

#include "kernels/stars/search/patch_motion.h"
#include "render/lens/stations/lens_position.h"
#include "render/passes/stars/search/star_patches.h"

namespace ergodome {

//! Cells of camera positions: in each, one star grid serves all positions. The cells are fixed, so
//! the grid for a position does not depend on where the camera was before. These are the extents of
//! a cell.
inline constexpr double position_cell_height = 0.03;   //!< along the logarithm of the height above the horizon
inline constexpr double position_cell_theta = 0.0075;  //!< along θ [rad]

//! Returns the largest offset from the middle of a cell, along r [M] and θ [rad].
LensPosition cell_reach(Spacetime spacetime, const LensPosition& middle);

//! Returns the middle of the cell that contains a position; nothing where the lens varies too much
//! within a cell: near the horizon, inside it, and near the spin axis.
std::optional<LensPosition> cell_middle(Spacetime spacetime, const LensPosition& position);

//! Memory of a cell's patches that is reused for the next cell.
struct MotionRoom {
  PatchRoom patches;
  std::vector<PatchMotion> motions;
};

//! Patches for the search of star images at all camera positions in a cell.
//!
//! The patches for the middle of the cell are moved by a polynomial in the camera's r and θ, whose
//! coefficients are those of the grid's nodes (add_cell_motion()). That takes much less time than
//! tracing and inverting a grid for the position.
class MovingPatches {
 public:
  //! `station`: the grid of the middle of the cell, from build_moving_station(). `patches`: the
  //! patches for it. Takes the memory of `room.motions`.
  MovingPatches(LensStation station, StarPatches patches, MotionRoom& room);

  //! Returns the memory, so that it can be used for another cell.
  [[nodiscard]] MotionRoom given_up() &&;

  //! Returns the chart of a position in the cell, as a station without nodes.
  [[nodiscard]] LensStation station_at(const LensPosition& position) const;

  //! Returns the patches for a position in the cell. `there`: the result of station_at(). Takes
  //! the memory of `room.patches`.
  [[nodiscard]] StarPatches patches_at(const LensStation& there, PatchRoom& room) const;

 private:
  void widen(StarPatch& patch, const PatchMotion& motion) const;

  LensStation station_;
  StarPatches patches_;
  std::vector<PatchMotion> motions_;
  LensPosition reach_;         //!< largest offset from the middle of the cell
  double largest_turn_ = 0.0;  //!< largest rotation of the sky between the middle and a position [rad]
};

}  // namespace ergodome
