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

//! The camera at a show time: at the keys exactly as they say; between them r (its logarithm), θ and φ follow C¹ cubics that do not
//! overshoot, and the orientation a C¹ quaternion spline. Before the first key and after the last one the camera holds.
CameraPose camera_pose(const Show& show, double time_s);

//! Orientation of one key.
glm::dquat key_orientation(const CameraKey& key);

}  // namespace ergodome
