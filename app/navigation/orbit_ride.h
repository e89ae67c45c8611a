#pragma once

#include <optional>

#include "app/navigation/camera_placement.h"
#include "app/navigation/flight_space.h"
#include "kernels/spacetime/geodesic/timelike_orbit.h"

namespace ergodome {

//! A camera in free fall along a timelike geodesic. Its clock runs as fast as comfort allows.
//!
//! A ride through the horizon uses ingoing Kerr azimuths, also in its CameraPlacement. The velocity
//! of such a ride is in the rain frame, from which the axes are boosted
//! (CameraPose::velocity_in_rain).
class OrbitRide {
 public:
  //! Starts a ride outside the horizon; `velocity` is in the ZAMO frame and slower than light.
  OrbitRide(const FlightSpace& space, const FlightSettings& settings, const CameraPlacement& placement,
            const Vector3<double>& velocity);

  //! Returns a ride through the horizon or inside it, from a pose with a velocity in the rain
  //! frame.
  static OrbitRide through_horizon(Spacetime spacetime, const FlightSettings& settings, const CameraPose& pose);

  //! Calls match_motion() if the camera's velocity is along the orbit, within 0.02 distances/s.
  //! Otherwise returns false and changes nothing.
  [[nodiscard]] bool take_over(const CameraPlacement& placement, const glm::dvec3& velocity);

  //! Sets the clock rate so that the camera moves at the component of its velocity [distances/s of
  //! `space()`] along the orbit, or rests if that is backward.
  void match_motion(const CameraPlacement& placement, const glm::dvec3& velocity);

  //! Takes the clock rate of another OrbitRide that describes the same orbit.
  void take_clock_of(const OrbitRide& other);

  //! Advances by a time of the visitor's clock. `hurry` from 0 to 1 speeds up the orbit's clock up
  //! to four times, within the limits of comfort. Changes the position in `placement`, not the
  //! view.
  void advance(double seconds, double hurry, CameraPlacement& placement);

  //! Returns the velocity in the ZAMO frame; for a ride through the horizon, in the rain frame.
  [[nodiscard]] Vector3<double> velocity() const;

  //! Returns dr per second of the visitor's clock [M/s].
  [[nodiscard]] double radial_speed() const;

  [[nodiscard]] bool leads_through_horizon() const { return constants_.ingoing; }
  [[nodiscard]] const FlightSpace& space() const { return space_; }

  //! Returns whether this orbit leads into the hole from a position outside the horizon.
  [[nodiscard]] bool falls_into_hole() const;

  //! Returns the camera's proper time since the ride began [M].
  [[nodiscard]] double proper_time() const { return proper_time_; }

  //! Returns the camera's proper time to the smallest radius of a ride through the horizon [M].
  //! Returns nothing if that is too far ahead to compute.
  [[nodiscard]] std::optional<double> left() const { return left_; }

  //! Returns whether the clock has almost or quite stopped, because the orbit leads out of the
  //! space for visitors.
  [[nodiscard]] bool held() const { return held_; }

 private:
  OrbitRide(const FlightSpace& space, const FlightSettings& settings, double r, const OrbitConstants& constants,
            const OrbitState& orbit);

  //! Returns the clock rate for a visitor who does not hurry, without the limits of comfort: the
  //! orbit's time [M] per second.
  [[nodiscard]] double usual_clock() const;
  //! Returns the maximum comfortable orbit time [M] per second; `reach` is the orbit time [M] per
  //! unit of distance.
  [[nodiscard]] double comfortable_clock(double reach, double usual) const;
  //! Returns a clock rate [M/s], reduced near the border of the space for visitors.
  [[nodiscard]] double slowed(double clock) const;
  //! Returns the clock rate [M/s], at least 0, at which the motion along the orbit equals the
  //! component of a velocity [distances/s] along it.
  [[nodiscard]] double clock_along(const CameraPlacement& placement, const glm::dvec3& velocity) const;
  //! Returns the camera's velocity along the orbit per proper time [distances/M].
  [[nodiscard]] glm::dvec3 way(const CameraPlacement& placement) const;
  [[nodiscard]] OrbitState rate() const { return orbit_rate(space_.spacetime(), constants_, orbit_); }
  void estimate_left(double r);
  [[nodiscard]] std::optional<double> time_to_deepest() const;

  FlightSpace space_;
  OrbitState orbit_;
  OrbitConstants constants_;
  double begin_r_;      //!< radius at the start of the ride [M]
  double clock_ = 0.0;  //!< orbit time per second of the visitor's clock [M/s]
  double proper_time_ = 0.0;
  double fastest_turn_;
  double fastest_;
  double accel_;
  std::optional<double> left_;        //!< result of left() [M]
  double left_estimated_at_r_ = 0.0;  //!< radius at which `left_` was last computed by integration [M]
  bool held_ = false;
  //! True if the ride took over a velocity that is faster than comfortable, and is still slowing
  //! down.
  bool taken_over_ = false;
};

//! Returns the velocity in the ZAMO frame of an observer with the angular velocity of a circular
//! equatorial orbit at the same radius, limited as by nearest_velocity(). It is prograde if `sense`
//! is positive, otherwise retrograde.
Vector3<double> circular_velocity(Spacetime spacetime, double r, double theta, double sense);

//! ingoing_placement() converts a pose to a CameraPlacement with the ingoing Kerr azimuth,
//! pose_of_ingoing() converts back. Inside the horizon, poses already have that azimuth.
CameraPlacement ingoing_placement(const CameraPose& pose, Spacetime spacetime);
CameraPose pose_of_ingoing(const CameraPlacement& placement, Spacetime spacetime);

}  // namespace ergodome
