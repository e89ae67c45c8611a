#pragma once

#include <ostream>
#include <string>
#include <vector>

#include "kernels/spacetime/kerr/camera_station.h"

// Cameras and rays that are numerically difficult ("hard cases"), and the errors that each method
// may have there.
namespace ergodome::test {

//! The position and the motion of a camera.
struct CameraState {
  double spin;
  double r;      //!< Boyer-Lindquist radius [M]
  double theta;  //!< polar angle [rad]
  ObserverMotion motion = ObserverMotion::zamo;
  Vector3<double> beta{};
};

inline CameraStation station_at(const CameraState& camera_state) {
  return make_camera_station(Spacetime{camera_state.spin}, camera_state.r, camera_state.theta, 0.0, camera_state.motion,
                             camera_state.beta);
}

using Directions = std::vector<Vector3<double>>;

//! The maximum errors of each method in a case. If a limit is `unbounded`, the error does not
//! matter, but the method must still return unit vectors or no sky, and never NaN; it may report
//! that it did not converge.
struct Allowed {
  //! Rays in double: maximum error of the sky direction, in excess of what the rounding of the
  //! direction causes [rad].
  double sky;
  //! Rays in float: maximum displacement of directions on the observer's screen [rad].
  double float_ray;
  //! Live grid: maximum 99th percentile of the displacement of directions from the exact ones on
  //! the observer's screen, in pixels of a 4096² dome.
  double grid_px;
  //! The same maximum for a blend halfway between two streamed stations.
  double streamed_px;
  //! Published quadtree grid: maximum 75th percentile of that displacement, in pixels of a 4096²
  //! dome.
  double quadtree_px;
};

inline constexpr double unbounded = 1e300;
//! A limit with which only this is checked: whether a ray is dark.
inline constexpr double side_alone = 1e200;
//! A limit that skips the method in this case, because the test would take long and show little.
inline constexpr double not_asked = -1.0;

//! A hard case: a camera, the rays that are numerically difficult for it, and the limits of each
//! method.
struct HardCase {
  const char* name;
  CameraState camera_state;
  Directions (*rays)(const CameraStation& camera);
  Allowed allowed;
  const char* why;  //!< the reason for the limits, for test messages
};

const std::vector<HardCase>& hard_cases();

inline std::string name_of(const HardCase& hard) { return hard.name; }

//! Writes the name of the case in test messages.
inline std::ostream& operator<<(std::ostream& out, const HardCase& hard) { return out << hard.name; }

}  // namespace ergodome::test
