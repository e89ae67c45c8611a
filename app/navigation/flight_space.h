#pragma once

#include "app/navigation/camera_placement.h"
#include "content/show/show.h"

namespace ergodome {

//! The region that a visitor's camera may enter, with its measure of lengths.
//!
//! Speeds are in units of distance(), which grows with the distance from the guard, so a flight is
//! fast far out and slow near the hole. A camera that flies toward the guard approaches it
//! asymptotically, for any time step.
class FlightSpace {
 public:
  FlightSpace(Spacetime spacetime, const FlightSettings& settings);

  //! Returns the space of a camera that falls through the horizon: its guard is at the smallest
  //! radius that falls reach. Lengths are in ingoing Kerr coordinates, r and angles times r,
  //! because proper lengths have no meaning there.
  static FlightSpace through_horizon(Spacetime spacetime, const FlightSettings& settings);

  [[nodiscard]] Spacetime spacetime() const { return spacetime_; }
  //! Returns the minimum radius of cameras [M].
  [[nodiscard]] double guard_r() const { return guard_r_; }

  //! Returns the unit of speed at a radius, as proper length per second [M]. It is positive at the
  //! guard, so that cameras can leave it.
  [[nodiscard]] double distance(double r) const;

  //! Returns the radius after `seconds` at dr/dt = `speed` [M/s], slowed down near the limits. A
  //! camera inside the guard moves out.
  [[nodiscard]] double moved_radius(double r, double speed, double seconds) const;

  //! Returns the factor on a motion at dr/dt = `speed` that keeps it within the limits of
  //! moved_radius().
  [[nodiscard]] double slowing(double r, double speed) const;

  //! Moves a camera without rotation for `seconds`, at a velocity [distances/s] in the local space
  //! of the zero-angular-momentum observer, whose e_r, e_θ, e_φ are `towards`, south and east.
  void move(CameraPlacement& placement, const glm::dvec3& velocity, double seconds) const;

  //! Returns the velocity [distances/s] of a camera whose radius and direction change at these
  //! rates.
  [[nodiscard]] glm::dvec3 velocity(const CameraPlacement& placement, double r_rate,
                                    const glm::dvec3& towards_rate) const;

 private:
  FlightSpace(Spacetime spacetime, const FlightSettings& settings, double guard_r, bool through_horizon);

  Spacetime spacetime_;
  double guard_r_;
  double max_r_;
  double fastest_;  //!< maximum speed [distances/s]
  bool through_horizon_;
};

//! Returns the radius of the guard [M]: just outside the horizon, or outside all photon orbits; at
//! least `settings.least_r`.
double guard_radius(Spacetime spacetime, const FlightSettings& settings);

//! Returns whether a camera is inside the horizon, or so close to it that it can only fall: frames
//! of other observers are boosted so strongly against the infalling one that few digits remain.
bool is_beyond_return(Spacetime spacetime, double r);

//! Returns whether infalling orbits take a visitor of a show through the horizon: if everything in
//! the show can be seen from inside (kept_outside) and its guard is the horizon.
bool may_fall_through_horizon(const Show& show);

}  // namespace ergodome
