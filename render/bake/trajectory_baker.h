#pragma once

#include <functional>

#include "content/show/show.h"
#include "content/trajectory/trajectory.h"

// Bakes the stations of a show's camera path.

namespace ergodome {

class TrajectoryJournal;

//! Settings of a bake.
struct BakeSettings {
  double pixel = 0.0;  //!< angle that a pixel of the screen subtends [rad]
  double share = 1.0;  //!< fraction of all directions that the screen shows (sky_share())
  //! Maximum displacement of directions on the screen by interpolation [px], for all but a
  //! hundredth of the screen in any orientation of the camera.
  double budget_px = 0.25;
  //! True: stations are baked with their derivatives along r and θ. Fewer stations then suffice,
  //! and they can be used for both eyes of a stereo pair.
  bool derivatives = true;
  //! Number, from 1, of the part to bake; the show is divided into `parts` of equal length.
  int part = 1;
  int parts = 1;
};

//! Result of a bake.
struct BakeResult {
  std::vector<double> times_s;  //!< times of the stations, in order
  int built = 0;                //!< stations that the journal did not have
  //! Number of gaps between stations whose error exceeds the budget because they are not divided
  //! further (short, or without improvement).
  int unmet = 0;
  double worst_px = 0.0;      //!< largest blending error in any gap between two stations
  double worst_time_s = 0.0;  //!< show time in the middle of that gap
  //! Duration of the show in which blending the disk layers exceeds the budget, so that players
  //! compute the layers live [s].
  double live_disk_s = 0.0;
};

//! Places stations along a show's camera path and builds those that the journal lacks; for a show
//! with a disk, also the disk's layers at each station.
//!
//! The path is divided at camera keys, between which r and θ are monotonic, and further until
//! blending is accurate. A stretch between two stations is divided again if the blend of the two
//! misses traced rays, at a quarter, half or three quarters of the stretch, by more than the budget
//! and by more than the stations miss them at their own positions. If a station misses rays by
//! almost as much at its own position, it is rebuilt with finer cells. Stretches of a few frames
//! are not divided, nor are stretches whose division does not reduce the error. The error of the
//! shadow's edge at the ends of a stretch (EdgeMiss) is also limited. Where the camera stands still
//! while its velocity changes, the first station is used for the whole stretch, which is divided if
//! that station's error at the end is too large.
//!
//! If a bake is divided into parts, every stretch that touches this part is processed, so that all
//! parts together contain the stations of a whole bake. `proceed` receives the show time up to
//! which the bake is done; if it returns false, the bake stops with an Error.
BakeResult bake_trajectory(const Show& show, const BakeSettings& settings, TrajectoryJournal& journal,
                           const std::function<bool(double)>& proceed);

//! Returns what a bake is made from: the program's version, the show without its timeline, the
//! spacetime and the settings. Throws Error if the spin is animated.
TrajectoryProvenance provenance_of(const Show& show, const BakeSettings& settings);

}  // namespace ergodome
