#pragma once

#include <span>
#include <vector>

#include "app/budget/budget.h"
#include "app/budget/budget_choice.h"

namespace ergodome {

//! Settings and size of pictures in a running show.
struct Rung {
  //! Quality settings, whose error budget is in pixels of the whole picture, also for smaller
  //! pictures.
  FrameQuality quality;
  int size_px = 0;        //!< width of one eye's picture
  double error_px = 0.0;  //!< measured error of its lens [px of the whole picture]
  int moments = 0;        //!< number of show times at which the error was measured
  double frame_ms = 0.0;  //!< predicted from the measurement; NaN: unknown
};

//! Limits of a ladder.
struct LadderLimits {
  int widest_px = 1024;
  int narrowest_px = 192;        //!< equal to the widest: fixed size
  double height_to_width = 1.0;  //!< ratio of height to width of one eye's picture
  //! How long a frame waits for its lens before it uses an older one.
  double patience_ms = 20.0;
  //! With an automatic lens, pictures with fewer pixels than this use direct rays.
  double grid_from_pixels = 0.0;
};

//! Returns the settings for a running show that has to hold a rate, the most accurate first, each
//! predicted to be faster than the one before; if times are unknown, all are returned.
//!
//! If the budget has an error: the cheapest lens within it in smaller and smaller pictures, then
//! the smallest picture with the point filter for the sky map, then that with coarser lenses, which
//! may exceed the error. If it has no error: whole pictures with coarser and coarser lenses, up to
//! one pixel of error, then the same steps. Adjacent sizes differ by at most a third of the pixels,
//! so that no step is visible as a jump.
std::vector<Rung> settings_ladder(std::span<const MeasuredSetting> settings, const Budget& budget,
                                  const LadderLimits& limits);

//! Returns the index of the first rung whose predicted time is at most foretold_share of the frame
//! time. If no rung is that fast, or if no time is known, returns the index of the first rung with
//! the smallest pictures; the RateKeeper continues from there.
std::size_t first_rung(std::span<const Rung> ladder, double frame_ms);

//! Maximum share of the frame time that the first rung may be predicted to take; the window needs
//! the rest.
inline constexpr double foretold_share = 0.65;

}  // namespace ergodome
