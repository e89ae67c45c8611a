#pragma once

#include "app/navigation/camera_placement.h"
#include "app/navigation/flight_space.h"

namespace ergodome {

//! The way of a camera back to a show's path, which continues meanwhile.
//!
//! It begins with the camera's velocity and ends with the path's. Direction and view are those of
//! the path, rotated by the remaining difference. The height above the horizon is a weighted
//! geometric mean of the path's and of the height that the camera coasts to, so it is never below
//! the lower of the two.
class PathReturn {
 public:
  //! Takes camera and path at two instants, `seconds` apart: [0] is earlier, [1] is the start. If
  //! the camera is at rest, both of its positions are equal.
  PathReturn(const FlightSpace& space, const FlightSettings& settings, const CameraPlacement (&camera)[2],
             const CameraPose (&path)[2], double seconds);

  //! Advances by a time toward the path's current pose. Returns the new position.
  CameraPlacement advance(double seconds, const CameraPose& path);

  [[nodiscard]] bool arrived() const { return elapsed_s_ >= duration_s_; }
  [[nodiscard]] double duration_s() const { return duration_s_; }
  [[nodiscard]] double left_s() const { return duration_s_ - elapsed_s_; }

 private:
  //! Difference between a camera and the path: rotations of the direction and of the view, as axis
  //! times angle in the path's local frame.
  struct Offset {
    glm::dvec3 direction{0.0};
    glm::dvec3 view{0.0};
  };
  [[nodiscard]] static Offset offset(const CameraPlacement& camera, const CameraPose& path);

  FlightSpace space_;
  double horizon_r_;
  Offset start_;
  Offset rate_;
  double coasting_r_;
  double radial_speed_;  //!< dr/dt at the start [M/s]
  double duration_s_;
  double elapsed_s_ = 0.0;
};

}  // namespace ergodome
