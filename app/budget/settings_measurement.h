#pragma once

#include <limits>
#include <string>
#include <vector>

#include "app/budget/budget.h"
#include "app/budget/budget_choice.h"
#include "app/budget/deadline.h"

namespace ergodome {

//! Input of measure_settings().
struct MeasurementOrder {
  Budget budget;
  int size_px = 0;  //!< width of one eye's whole picture; 0: the show's
  //! The operator's choice; with `automatic`, direct rays are measured too.
  LensChoice lens = LensChoice::automatic;
  //! The camera will leave its path, so each frame needs a new lens.
  bool free_flight = false;
  double limit_s = 2.0;  //!< time limit of the measurement
  SecondsSource now = steady_seconds;
};

//! Why the time of whole frames is unknown.
enum class UntimedFrames {
  none,      //!< the time is known
  for_time,  //!< time ran out before enough pictures were drawn
  polygons,  //!< objects are drawn as polygons, and OpenGL takes seconds to start without a GPU
};

//! Result of a measurement, and how much of it was completed.
struct SettingsMeasurement {
  std::vector<MeasuredSetting> settings;  //!< at least one; the first has the requested lens
  std::vector<double> times_s;            //!< show times at which errors were measured
  int width_px = 0;                       //!< width of one eye's whole picture
  double height_to_width = 1.0;           //!< ratio of height to width of one eye's whole picture
  //! Widths of the pictures that were timed: two, from which times were extrapolated, or only
  //! `width_px`; empty: none.
  std::vector<int> drawn_px;
  UntimedFrames untimed = UntimedFrames::none;
  //! If whole frames were not timed: the time of the fastest picture drawn; NaN: none was drawn.
  double quickest_ms = std::numeric_limits<double>::quiet_NaN();
  int quickest_px = 0;     //!< width of the fastest picture drawn
  bool cut_short = false;  //!< time ran out before everything was measured
  double took_s = 0.0;
};

//! Measures errors and times of settings at a few times of `show`, the show that the renderer was
//! made for. Errors are those of the whole picture's lens, in some of its pixels, against rays in
//! closed form; times of whole frames come from a PictureTimer.
//!
//! With an error in the budget, lenses get finer until one is within kept_share of it; with a rate
//! alone, down to 0.015 px or as fine as time allows. Disk, shells and objects add to the time but
//! not to the error. If objects are drawn as polygons and there is no GPU, no picture is drawn,
//! because OpenGL takes seconds to start. In stereo, the head's view represents both eyes. Restores
//! the renderer's quality. Throws what rendering throws.
SettingsMeasurement measure_settings(ShowRenderer& renderer, const Show& show, const MeasurementOrder& order);

//! Returns `count` show times to measure at [s]: first where r plus the horizon's radius is
//! smallest, then evenly spaced. If nothing moves, returns only the middle of the show.
std::vector<double> budget_times(const Show& show, int count);

}  // namespace ergodome
