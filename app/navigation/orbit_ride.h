#pragma once

#include <optional>

#include "app/navigation/camera_place.h"
#include "app/navigation/flight_space.h"
#include "kernels/spacetime/geodesic/timelike_orbit.h"

namespace ergodome {

//! A camera that falls freely along a timelike geodesic; its clock runs as fast as comfort allows.
//!
//! One that falls through the horizon counts azimuths as ingoing Kerr coordinates do, and so do its places; its velocity is one in the rain's
//! frame, from which the axes are boosted (CameraPose::velocity_in_rain).
class OrbitRide {
 public:
  //! Outside the horizon; `velocity` is that of the ZAMO frame, slower than light.
  OrbitRide(const FlightSpace& space, const FlightSettings& settings, const CameraPlace& place,
            const Vector3<double>& velocity);

  //! Through the horizon, or within it: from a pose whose velocity is one in the rain's frame.
  static OrbitRide through_horizon(double spin, const FlightSettings& settings, const CameraPose& pose);

  //! Begins at the velocity [distances/s] of `space()` that the camera has where that leads along the orbit, as fast as it asks for; else
  //! does not begin, and says so.
  [[nodiscard]] bool take_over(const CameraPlace& place, const glm::dvec3& velocity);

  //! Begins as fast along the orbit as the camera goes, whatever it does beside that.
  void go_as(const CameraPlace& place, const glm::dvec3& velocity);

  //! Begins as fast as another description of this ride.
  void take_clock_of(const OrbitRide& other);

  //! Goes on by some time of the visitor's; `hurry` from 0 to 1 asks for more time of the orbit's in it. Turns nothing but `towards`.
  void advance(double seconds, double hurry, CameraPlace& place);

  //! The velocity in the ZAMO frame; in the rain's of a ride through the horizon.
  [[nodiscard]] Vector3<double> velocity() const;

  //! dr over a second of the visitor's [M/s].
  [[nodiscard]] double radial_speed() const;

  [[nodiscard]] bool leads_through_horizon() const { return constants_.ingoing; }
  [[nodiscard]] const FlightSpace& space() const { return space_; }

  //! Whether this orbit would lead into the hole from a place outside the horizon.
  [[nodiscard]] bool falls_into_hole() const;

  //! The camera's own time since the ride began [M].
  [[nodiscard]] double own_time() const { return own_time_; }

  //! The camera's own time to the deepest place of a ride through the horizon [M]; nothing where that is too far ahead to be told.
  [[nodiscard]] std::optional<double> left() const { return left_; }

  //! Whether the orbit leads out of the space for visitors: its clock comes to rest at the border.
  [[nodiscard]] bool held() const { return held_; }

 private:
  OrbitRide(const FlightSpace& space, const FlightSettings& settings, double r, const OrbitConstants& constants,
            const OrbitState& orbit);

  //! Time of the orbit [M] in a second of a visitor who does not hurry.
  [[nodiscard]] double usual_clock() const;
  //! The most time of the orbit [M] in a second of a visitor's that comfort allows here; `reach` is the orbit's time [M] for a distance.
  [[nodiscard]] double comfortable_clock(double reach, double usual) const;
  //! A clock slowed down before the border of the space for visitors.
  [[nodiscard]] double slowed(double clock) const;
  //! The clock at which the way along the orbit is that of a velocity [distances/s].
  [[nodiscard]] double clock_along(const CameraPlace& place, const glm::dvec3& velocity) const;
  //! The way [distances] that the orbit goes in its own time [M].
  [[nodiscard]] glm::dvec3 way(const CameraPlace& place) const;
  [[nodiscard]] OrbitState rate() const { return orbit_rate(space_.spin(), constants_, orbit_); }
  void tell_left(double r);
  [[nodiscard]] std::optional<double> time_to_deepest() const;

  FlightSpace space_;
  OrbitState orbit_;
  OrbitConstants constants_;
  double begin_r_;      //!< [M]
  double clock_ = 0.0;  //!< [M/s]
  double own_time_ = 0.0;
  double fastest_turn_;
  double fastest_;
  double accel_;
  std::optional<double> left_;  //!< [M]
  double left_told_r_ = 0.0;    //!< where that was found by following the orbit [M]
  bool held_ = false;
  bool taken_over_ = false;  //!< from a path that went faster than comfort would: the clock is coming down to it
};

//! Velocity of a circular equatorial orbit at a radius, or the nearest possible one, along +φ where `sense` is positive.
Vector3<double> circular_velocity(double spin, double r, double theta, double sense);

//! The place of a pose, with its azimuth as ingoing Kerr coordinates have it, and back. Within the horizon poses have that azimuth already.
CameraPlace ingoing_place(const CameraPose& pose, double spin);
CameraPose pose_of_ingoing(const CameraPlace& place, double spin);

}  // namespace ergodome
