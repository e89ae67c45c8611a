#pragma once

#include <ostream>
#include <string>
#include <vector>

#include "kernels/spacetime/kerr/camera_station.h"

namespace ergodome::test {

//! Where a camera is, and how it moves.
struct Place {
  double spin;
  double r;      //!< [M]
  double theta;  //!< [rad]
  ObserverMotion motion = ObserverMotion::zamo;
  Vector3<double> beta{};
};

inline CameraStation station_at(const Place& place) {
  return make_camera_station(place.spin, place.r, place.theta, 0.0, place.motion, place.beta);
}

using Directions = std::vector<Vector3<double>>;

//! What a case may miss by. Of a method that is not asked anything else (`unbounded`) there must
//! still be unit vectors or none, and no NaN; it may say that it did not converge.
struct Allowed {
  double sky;  //!< rays in double: error of the sky direction, beside what rounding of the input makes of it [rad]
  double float_ray;    //!< rays in float: greatest displacement on the observer's screen [rad]
  double grid_px;      //!< live grid: displacement at the 99th of hundred rays, in pixels of a dome of 4096²
  double streamed_px;  //!< the same halfway between two stations
  double quadtree_px;  //!< the same of the published grid, at the 75th of hundred rays
};

inline constexpr double unbounded = 1e300;
inline constexpr double side_alone = 1e200;  //!< asked is only whether it is dark
inline constexpr double not_asked = -1.0;    //!< costs more than it tells

//! One hard case: a camera, the rays that are hard there, and what each method may miss by.
struct HardCase {
  const char* name;
  Place place;
  Directions (*rays)(const CameraStation& camera);
  Allowed allowed;
  const char* why;  //!< these numbers
};

const std::vector<HardCase>& hard_cases();

inline std::string name_of(const HardCase& hard) { return hard.name; }

//! For messages of tests.
inline std::ostream& operator<<(std::ostream& out, const HardCase& hard) { return out << hard.name; }

}  // namespace ergodome::test
