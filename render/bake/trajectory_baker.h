#pragma once

#include <functional>

#include "content/show/show.h"
#include "content/trajectory/trajectory.h"

// Bakes the stations of a show's camera path.

namespace ergodome {

class TrajectoryJournal;

//! Settings of a bake.
struct BakeSettings {
  double pixel = 0.0;  //!< angle of a pixel on the screen [rad]
  double share = 1.0;  //!< share of the sky that the screen shows (sky_share)
  //! Maximum displacement on the screen, for all but a hundredth of it in any direction.
  double budget_px = 0.25;
  //! Bake stations with their derivatives along r and θ: fewer stations suffice, and they serve
  //! both eyes of a stereo pair.
  bool derivatives = true;
  int part = 1;  //!< this one of `parts` stretches of the show, of equal length, counted from 1
  int parts = 1;
};

//! Result of a bake.
struct BakeResult {
  std::vector<double> times_s;  //!< times of the stations, in order
  int built = 0;                //!< stations that the journal did not have
  int unmet = 0;                //!< gaps that stayed over the budget, however close their stations
  double worst_px = 0.0;        //!< largest error of a gap
  double worst_time_s = 0.0;    //!< the middle of that gap
  //! Show time in which blending the disk's layers exceeds the budget, so that they are computed
  //! live.
  double live_disk_s = 0.0;
};

//! Places stations along a show's camera path and builds those that the journal lacks; for a show
//! with a disk, also the disk's layers at each station.
//!
//! Between two camera keys, r and θ are monotonic. A stretch is divided if the blend of its ends
//! misses traced rays, at a quarter, half or three quarters of it, by more than the budget and by
//! more than the stations miss them at their own positions. A station that misses by almost as much
//! at its own position is built finer. Stretches of a few frames are not divided, nor are stretches
//! whose division does not help. The error of the shadow's edge at the ends (EdgeMiss) counts for a
//! stretch, too. Where the camera stands still while its velocity changes, the first station serves
//! the whole stretch, which is divided according to the error at its end.
//!
//! With parts, every stretch that touches this part is processed, so that the parts of a bake
//! together hold what a whole bake needs. `proceed` receives the show time up to which the bake is
//! done; if it returns false, the bake stops with an Error.
BakeResult bake_trajectory(const Show& show, const BakeSettings& settings, TrajectoryJournal& journal,
                           const std::function<bool(double)>& proceed);

//! Returns the provenance of a bake.
TrajectoryProvenance provenance_of(const Show& show, const BakeSettings& settings);

}  // namespace ergodome
