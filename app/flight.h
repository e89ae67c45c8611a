#pragma once

#include "content/camera_path.h"
#include "content/show.h"

namespace ergodome {

//! A camera that a person steers: it starts where the show is, orbits the hole and looks around.
class Flight {
 public:
  explicit Flight(const Show& show) : show_(show), pose_(camera_pose(show, show.camera.keys.front().time_s)) {}

  [[nodiscard]] const CameraPose& pose() const { return pose_; }

  //! Takes over from the show.
  void start_at(const CameraPose& pose) { pose_ = pose; }

  //! Turns the view: to the right and upwards [rad].
  void look(double right, double up);

  //! Moves the camera: along φ and towards the south [rad], and outwards by a factor on its height above the least radius.
  void orbit(double along_phi, double along_theta, double outward_factor);

 private:
  Show show_;
  CameraPose pose_;
};

//! Smallest radius that a visitor may fly to: outside the horizon, and outside where the show's observer can exist.
double least_radius(const Show& show);

}  // namespace ergodome
