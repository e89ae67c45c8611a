#pragma once

#include "app/navigation/camera_place.h"
#include "app/navigation/flight_space.h"

namespace ergodome {

//! The way of a camera back to a show's path that goes on meanwhile.
//!
//! It begins with the camera's own velocity and ends with the path's. The direction and the view are those of the path, turned by what
//! is left of the difference; the height above the horizon is a mean of the path's and of what the camera coasts to, and so never below
//! both.
class PathReturn {
 public:
  //! Two instants that are `seconds` apart, of the camera and of the path; a camera that is at rest has two that are the same.
  PathReturn(const FlightSpace& space, const FlightSettings& settings, const CameraPlace (&camera)[2],
             const CameraPose (&path)[2], double seconds);

  //! Goes on by some time, towards where the path is then.
  CameraPlace advance(double seconds, const CameraPose& path);

  [[nodiscard]] bool arrived() const { return elapsed_s_ >= duration_s_; }
  [[nodiscard]] double duration_s() const { return duration_s_; }
  [[nodiscard]] double left_s() const { return duration_s_ - elapsed_s_; }

 private:
  //! What is between a camera and the path: rotations of the direction and of the view, as axis times angle in the path's local frame.
  struct Offset {
    glm::dvec3 direction{0.0};
    glm::dvec3 view{0.0};
  };
  [[nodiscard]] static Offset offset(const CameraPlace& camera, const CameraPose& path);

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
