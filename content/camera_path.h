#pragma once

#include <glm/gtc/quaternion.hpp>

#include "content/show.h"

namespace ergodome {

//! Where the camera is and how it is turned.
//!
//! `orientation` rotates the view's axes (x right, y up, z back, as in OpenGL) into the local frame (e_r, e_θ, e_φ). Looking at
//! the hole, right is e_φ, up is -e_θ (towards the spin axis) and back is e_r.
struct CameraPose {
  double r;      //!< [M]
  double theta;  //!< [rad]
  double phi;    //!< [rad]
  glm::dquat orientation;
};

//! The camera at a show time: at the keys exactly as they say, and for as long as they hold it.
//!
//! Between them r (its logarithm), θ and φ follow quintics that do not overshoot, and the orientation a quaternion spline; both are C²,
//! but beside Ease::linear and where the first or last way is told not to ease. Before the first key and after the last one it holds.
CameraPose camera_pose(const Show& show, double time_s);

//! Orientation of one key.
glm::dquat key_orientation(const CameraKey& key);

}  // namespace ergodome
