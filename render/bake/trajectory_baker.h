#pragma once

#include <functional>

#include "content/show/show.h"
#include "content/trajectory/trajectory.h"

namespace ergodome {

class TrajectoryJournal;

//! What a trajectory is baked for.
struct BakeSettings {
  double pixel = 0.0;       //!< angle of a pixel on the screen [rad]
  double share = 1.0;       //!< of the sky that the screen shows (sky_share)
  double budget_px = 0.25;  //!< greatest displacement on the screen, for all but a hundredth of it wherever it looks
  bool derivatives =
      true;      //!< stations with their change along r and θ: fewer do, and they serve both eyes of a stereo pair
  int part = 1;  //!< this one of `parts` stretches of the show, of equal length, counted from 1
  int parts = 1;
};

//! What a bake found.
struct BakeResult {
  std::vector<double> times_s;  //!< of the stations, in order
  int built = 0;                //!< stations that were not in the journal yet
  int unmet = 0;                //!< gaps that stayed over the budget, however near their stations
  double worst_px = 0.0;        //!< greatest error of a gap
  double worst_time_s = 0.0;    //!< in the middle of that gap
  double live_disk_s =
      0.0;  //!< of the show, where blending the disk's layers misses by more than the budget: they are made anew there
};

//! Places stations along a show's camera path and builds those that the journal lacks; for a show with a disk, the disk's layers at each of them,
//! too.
//!
//! Between two camera keys r and θ run monotonously; a stretch whose ends, blended, miss traced rays by more than the budget at a
//! quarter, half or three quarters of it, and by more than they do at their own places, is divided. A station that would miss by nearly as
//! much at its own place is built finer. Stretches of a few pictures are not divided, nor are those that miss as much in their parts' parts
//! as in the whole. How far off the shadow's edge is at the ends (EdgeMiss) counts for a stretch, too. Where the camera stands while its velocity goes over, the first station serves all the stretch, which is divided by what
//! it misses at the end. With parts, every stretch that touches this part is looked at, so that the parts of a bake together hold what a
//! whole bake needs. `proceed` is told the show time up to which all is done; false stops the bake with an Error.
BakeResult bake_trajectory(const Show& show, const BakeSettings& settings, TrajectoryJournal& journal,
                           const std::function<bool(double)>& proceed);

//! The provenance of a bake.
TrajectoryProvenance provenance_of(const Show& show, const BakeSettings& settings);

}  // namespace ergodome
