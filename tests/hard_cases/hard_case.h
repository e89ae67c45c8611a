#pragma once

#include <ostream>
#include <string>
#include <vector>

#include "kernels/spacetime/kerr/camera_station.h"

// The cases that are hard for lenses and rays, and the errors that each method may make there.
namespace ergodome::test {

//! The position and the motion of a camera.
struct Place {
  double spin;
  double r;      //!< [M]
  double theta;  //!< [rad]
  ObserverMotion motion = ObserverMotion::zamo;
  Vector3<double> beta{};
};

inline CameraStation station_at(const Place& place) {
  return make_camera_station(Spacetime{place.spin}, place.r, place.theta, 0.0, place.motion, place.beta);
}

using Directions = std::vector<Vector3<double>>;

//! The maximum errors of a case. A method with the limit `unbounded` must still return unit vectors
//! or no sky, and never NaN; it may report that it did not converge.
struct Allowed {
  double sky;          //!< rays in double: error of the sky direction beyond the effect of input rounding [rad]
  double float_ray;    //!< rays in float: maximum displacement on the observer's screen [rad]
  double grid_px;      //!< live grid: 99th percentile of the displacement, in pixels of a 4096² dome
  double streamed_px;  //!< halfway between two streamed stations: the same measure
  double quadtree_px;  //!< published grid: 75th percentile of the displacement
};

inline constexpr double unbounded = 1e300;
inline constexpr double side_alone = 1e200;  //!< checks only whether the ray is dark
inline constexpr double not_asked = -1.0;    //!< skipped: costs more than it shows

//! One hard case: a camera, the rays that are hard there, and the maximum error of each method.
struct HardCase {
  const char* name;
  Place place;
  Directions (*rays)(const CameraStation& camera);
  Allowed allowed;
  const char* why;  //!< the reason for these limits
};

const std::vector<HardCase>& hard_cases();

inline std::string name_of(const HardCase& hard) { return hard.name; }

//! Names the case in test messages.
inline std::ostream& operator<<(std::ostream& out, const HardCase& hard) { return out << hard.name; }

}  // namespace ergodome::test
