#pragma once

#include <array>

namespace ergodome {

//! The surface that a visitor's camera cannot enter: the horizon, or the outermost photon orbit.
//! Outside the latter, every kind of observer can exist.
enum class FlightGuard { horizon, photon_orbit };

//! Where free flight begins: at the show's camera, or at the show's first key.
enum class FlightStart { path, first_key };

//! Steering modes: around the hole; like a spaceship; hovering at a fixed position; in free fall.
enum class FlightMode { orbit, fly, hover, geodesic };
inline constexpr std::array flight_mode_names = {"orbit", "fly", "hover", "geodesic"};

//! Limits on the motion of a visitor's camera, whatever the input.
struct ComfortSettings {
  double turn_deg_s = 60.0;         //!< maximum turn rate of the view
  double turn_accel_deg_s2 = 90.0;  //!< maximum angular acceleration of the view
  //! Maximum acceleration per distance from the guard surface [1/s²].
  double accel = 1.5;

  bool operator==(const ComfortSettings&) const = default;
};

//! Settings of free flight: a show's [flight]. Distances are measured from the guard surface.
struct FlightSettings {
  FlightGuard guard = FlightGuard::horizon;
  FlightMode mode = FlightMode::orbit;
  FlightStart from = FlightStart::path;
  double max_speed = 0.6;  //!< maximum speed per distance from the guard surface [1/s]
  double least_r = 0.0;    //!< minimum radius, if it is outside the guard surface [M]; 0: none
  double most_r = 1e5;     //!< maximum radius [M]
  double return_s = 4.0;   //!< duration of the way back to the show's path; longer if `comfort` requires it
  ComfortSettings comfort;

  bool operator==(const FlightSettings&) const = default;
};

}  // namespace ergodome
