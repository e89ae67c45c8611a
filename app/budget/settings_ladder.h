#pragma once

#include <span>
#include <vector>

#include "app/budget/budget.h"
#include "app/budget/measured_setting.h"

namespace ergodome {

//! Settings and a size that pictures of a running show may have.
struct Rung {
  FrameQuality quality;   //!< its budget counts in pixels of the whole picture, which a smaller one keeps to
  int size_px = 0;        //!< width of one eye's picture
  double error_px = 0.0;  //!< as measured of its lens [px of the whole picture]
  int moments = 0;        //!< at which that was looked at
  double frame_ms = 0.0;  //!< as foretold from the measurement; NaN: not known
};

//! What a ladder may be made of.
struct LadderLimits {
  int widest_px = 1024;
  int narrowest_px = 192;        //!< the same as the widest: the size is fixed
  double height_to_width = 1.0;  //!< of one eye's picture
  double patience_ms = 20.0;     //!< how long a frame waits for its lens before it takes an older one
  double grid_from_pixels =
      0.0;  //!< pictures of fewer pixels are drawn by direct rays where the lens is chosen automatically
};

//! The settings of a running show that is to hold a rate, the most accurate first, each quicker than the one before by foresight.
//!
//! With an error in the budget all rungs but the last keep to it: the cheapest lens within it, in smaller and smaller pictures, then with a
//! plain look at the sky's map; only where that is not enough do coarser lenses follow. Without, coarser lenses up to a pixel come first. A
//! rung is lower than the next by a third of the pixels or half the lens's budget, so that no step is seen as a jump.
std::vector<Rung> settings_ladder(std::span<const MeasuredSetting> settings, const Budget& budget,
                                  const LadderLimits& limits);

//! The first rung whose foretold time leaves room in a frame of the budget's rate. Where none does, or no time is known, the smallest picture with
//! the best settings: what keeps the rate finds the way from there.
std::size_t first_rung(std::span<const Rung> ladder, double frame_ms);

//! Share of a frame's time that a picture may be foretold to take: the window needs the rest.
inline constexpr double foretold_share = 0.65;

}  // namespace ergodome
