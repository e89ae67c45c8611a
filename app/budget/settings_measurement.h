#pragma once

#include <limits>
#include <string>
#include <vector>

#include "app/budget/budget.h"
#include "app/budget/deadline.h"
#include "app/budget/measured_setting.h"

namespace ergodome {

//! What is to be measured.
struct MeasurementOrder {
  Budget budget;
  int size_px = 0;                          //!< width of one eye's whole picture; 0: as the show says
  LensChoice lens = LensChoice::automatic;  //!< what the person chose; direct rays are looked at beside `automatic`
  bool free_flight = false;                 //!< the camera will leave its path: each frame needs a lens of its own
  double limit_s = 2.0;                     //!< all ends within so many seconds
  SecondsSource now = steady_seconds;
};

//! Why no time of whole frames was told.
enum class UntimedFrames {
  none,      //!< it was
  for_time,  //!< the time was over before enough pictures were drawn
  polygons,  //!< OpenGL takes seconds to begin where there is no GPU, and nothing was drawn
};

//! What was measured, and how much of it there was time for.
struct SettingsMeasurement {
  std::vector<MeasuredSetting> settings;  //!< at least one; the first has the lens that was ordered
  std::vector<double> times_s;            //!< of the show, where errors were looked at
  int width_px = 0;                       //!< of one eye's whole picture
  double height_to_width = 1.0;           //!< of the same
  std::vector<int>
      drawn_px;  //!< widths of the pictures whose times whole pictures' were told from; none: nothing was drawn
  UntimedFrames untimed = UntimedFrames::none;
  double quickest_ms = std::numeric_limits<
      double>::quiet_NaN();  //!< of untimed frames: what a picture took that was drawn; NaN: none was
  int quickest_px = 0;       //!< width of that picture, up to the whole one's
  bool cut_short = false;    //!< there was no time for all
  double took_s = 0.0;
};

//! Looks at a few moments of a show, which the renderer was made for, what settings miss by and take: errors of the whole picture's lens, of some of its pixels
//! against light rays in closed form; times of whole frames, told from pictures of two small sizes.
//!
//! With an error in the budget lenses get finer until one is within it, with kept_share; with a rate alone as fine as there is time for. What
//! lies near the hole (disk, shells, objects) has a cost and no error. Polygons take OpenGL seconds to begin on a processor: then nothing is drawn. Of
//! two eyes the head stands for both. The renderer keeps its first quality. Throws what drawing throws.
SettingsMeasurement measure_settings(ShowRenderer& renderer, const Show& show, const MeasurementOrder& order);

//! Times of a show at which it is looked at: where the camera is nearest to the hole first, then evenly over it.
std::vector<double> budget_times(const Show& show, int count);

}  // namespace ergodome
