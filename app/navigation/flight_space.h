#pragma once

#include "app/navigation/camera_place.h"
#include "content/show/show.h"

namespace ergodome {

//! The space that a visitor's camera may be in, and what a length is there.
//!
//! Speeds are counted in distances from the guard, so that a flight is as fast far out as it is careful near the hole. However long a
//! camera flies towards the guard, and whatever the time between pictures, it only comes ever nearer to it.
class FlightSpace {
 public:
  FlightSpace(double spin, const FlightSettings& settings);

  //! The space of who falls through the horizon: its guard is the deepest place that falls lead to, and the coordinates that lengths are
  //! counted in are those of ingoing Kerr, r and angles times r, for proper lengths have no meaning there.
  static FlightSpace through_horizon(double spin, const FlightSettings& settings);

  [[nodiscard]] double spin() const { return spin_; }
  //! No camera comes nearer than this [M].
  [[nodiscard]] double guard_r() const { return guard_r_; }

  //! What a speed of 1 is, as a proper length a second [M]; some of it is left at the guard, to get away and around.
  [[nodiscard]] double distance(double r) const;

  //! The radius after `seconds` at dr/dt = `speed` [M/s], slowed as it nears its limits. A camera inside the guard is brought out.
  [[nodiscard]] double moved_radius(double r, double speed, double seconds) const;

  //! Fraction of a way inwards or outwards at dr/dt = `speed` that keeps to moved_radius's limits.
  [[nodiscard]] double slowing(double r, double speed) const;

  //! Moves a camera that does not turn by `seconds` at a velocity [distances/s] of the local space of the zero-angular-momentum observer,
  //! whose e_r, e_θ, e_φ are `towards`, south and east.
  void move(CameraPlace& place, const glm::dvec3& velocity, double seconds) const;

  //! The velocity [distances/s] of a camera whose radius and direction change at these rates.
  [[nodiscard]] glm::dvec3 velocity(const CameraPlace& place, double r_rate, const glm::dvec3& towards_rate) const;

 private:
  FlightSpace(double spin, const FlightSettings& settings, double guard_r, bool through_horizon);

  double spin_;
  double guard_r_;
  double most_r_;
  double fastest_;  //!< [distances/s]
  bool through_horizon_;
};

//! Radius of the guard [M]: just outside the horizon, or outside every orbit of light; further out where the settings say so.
double guard_radius(double spin, const FlightSettings& settings);

//! Whether a camera is within the horizon, or so near to it that there is nothing but to fall on: there the frames of who moves otherwise are
//! boosted from the falling one's so fast that few digits of them are left.
bool is_beyond_return(double spin, double r);

//! Whether orbits that fall into the hole lead a visitor of a show through its horizon: where all that the show has can be seen from within
//! (kept_outside), and what it guards is the horizon alone.
bool may_fall_through_horizon(const Show& show);

}  // namespace ergodome
