#pragma once

#include "app/navigation/camera_place.h"
#include "app/navigation/flight_space.h"
#include "kernels/geodesic/timelike_orbit.h"

namespace ergodome {

//! A camera that falls freely along a timelike geodesic; its clock runs as fast as comfort allows.
class OrbitRide {
 public:
  //! `velocity` is that of the ZAMO frame, slower than light.
  OrbitRide(const FlightSpace& space, const FlightSettings& settings, const CameraPlace& place,
            const Vector3<double>& velocity);

  //! Begins at the velocity [distances/s] that the camera has where that leads along the orbit, as fast as it asks for; else does not
  //! begin, and says so.
  [[nodiscard]] bool take_over(const CameraPlace& place, const glm::dvec3& velocity);

  //! Goes on by some time of the visitor's; `hurry` from 0 to 1 asks for more time of the orbit's in it. Turns nothing but `towards`.
  void advance(double seconds, double hurry, CameraPlace& place);

  //! The velocity in the ZAMO frame.
  [[nodiscard]] Vector3<double> velocity() const { return orbit_velocity(space_.spin(), orbit_); }

  //! Whether the orbit leads out of the space for visitors: its clock comes to rest at the border.
  [[nodiscard]] bool held() const { return held_; }

 private:
  //! The most time of the orbit [M] in a second of a visitor's that comfort allows here; `reach` is the orbit's time [M] for a distance.
  [[nodiscard]] double comfortable_clock(double reach) const;
  //! A clock slowed down before the border of the space for visitors.
  [[nodiscard]] double slowed(double clock) const;
  [[nodiscard]] OrbitState rate() const { return orbit_rate(space_.spin(), constants_, orbit_); }

  FlightSpace space_;
  OrbitState orbit_;
  OrbitConstants constants_;
  double usual_clock_;  //!< [M/s]
  double clock_ = 0.0;  //!< [M/s]
  double fastest_turn_;
  double fastest_;
  double accel_;
  bool held_ = false;
  bool taken_over_ = false;  //!< from a path that went faster than comfort would: the clock is coming down to it
};

//! Velocity of a circular equatorial orbit at a radius, or the nearest possible one, along +φ where `sense` is positive.
Vector3<double> circular_velocity(double spin, double r, double theta, double sense);

}  // namespace ergodome
