#pragma once

#include "app/navigation/camera_placement.h"
#include "content/show/show.h"

namespace ergodome {

//! The region that a visitor's camera may enter, with its measure of lengths.
//!
//! At a speed of 1 [distances/s], a camera moves by distance(r) per second. That unit grows with
//! the height above the guard, so a flight is fast far out and slow near the hole. A camera that
//! flies toward the guard approaches it asymptotically, for any time step.
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

  //! Returns the unit of length at a radius, the "distance" [M]: the height above the guard plus a
  //! twentieth of the guard's radius, so that cameras can leave the guard.
  [[nodiscard]] double distance(double r) const;

  //! Returns the radius after `seconds` at dr/dt = `speed` [M/s], slowed down near the limits. A
  //! camera inside the guard moves out.
  [[nodiscard]] double moved_radius(double r, double speed, double seconds) const;

  //! Returns the factor, 0 to 1, that slows down a motion at dr/dt = `speed` [M/s] as much as
  //! moved_radius() does near the limits.
  [[nodiscard]] double slowing(double r, double speed) const;

  //! Moves a camera without rotation for `seconds`, at a velocity [distances/s] in the local space
  //! of the zero-angular-momentum observer, whose e_r, e_θ, e_φ are `towards`, south and east.
  void move(CameraPlacement& placement, const glm::dvec3& velocity, double seconds) const;

  //! Inverts move(): returns the velocity [distances/s] of a camera whose radius changes by
  //! `r_rate` [M/s] and whose direction from the hole by `towards_rate` [1/s].
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

//! Returns the radius of the guard [M]. By `settings.guard` it is just outside the horizon or 1 %
//! outside all equatorial photon orbits; it is at least `settings.least_r`.
double guard_radius(Spacetime spacetime, const FlightSettings& settings);

//! Returns whether a camera is closer than `nearest_rest` horizon radii (content/camera/within.h),
//! or inside the horizon, so that it can only fall: so close, frames of other observers are boosted
//! so strongly against the infalling one that few digits remain.
bool is_beyond_return(Spacetime spacetime, double r);

//! Returns whether infalling orbits take a visitor of a show through the horizon: if everything in
//! the show can be seen from inside (kept_outside) and its guard is just outside the horizon, not
//! moved outward by `least_r`.
bool may_fall_through_horizon(const Show& show);

}  // namespace ergodome
