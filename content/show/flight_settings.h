#pragma once

#include <array>

namespace ergodome {

//! What a visitor's camera stays outside of: the horizon, or the farthest orbit of light, outside of which every observer exists.
enum class FlightGuard { horizon, photon_orbit };

//! Where free flight begins: where the show's camera is, or at the show's first key.
enum class FlightStart { path, first_key };

//! Ways to steer: around the hole; like a space ship; staying in place; falling freely on an orbit.
enum class FlightMode { orbit, fly, hover, geodesic };
inline constexpr std::array flight_mode_names = {"orbit", "fly", "hover", "geodesic"};

//! Limits that hold for whatever a visitor does.
struct ComfortSettings {
  double turn_deg_s = 60.0;         //!< fastest turn of the view
  double turn_accel_deg_s2 = 90.0;  //!< fastest change of that
  double accel = 1.5;               //!< fastest change of the speed [distances/s²]

  bool operator==(const ComfortSettings&) const = default;
};

//! How visitors may fly: a show's [flight]. Distances are those from the guard.
struct FlightSettings {
  FlightGuard guard = FlightGuard::horizon;
  FlightMode mode = FlightMode::orbit;
  FlightStart from = FlightStart::path;
  double max_speed = 0.6;  //!< [distances/s]
  double least_r = 0.0;    //!< a guard further out, in its place [M]; 0: none
  double most_r = 1e5;     //!< [M]
  double return_s = 4.0;   //!< time for the way back to the show's path; longer where comfort asks for it
  ComfortSettings comfort;

  bool operator==(const FlightSettings&) const = default;
};

}  // namespace ergodome
