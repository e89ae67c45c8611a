#pragma once

#include <glm/gtc/quaternion.hpp>

#include "content/camera/camera_path.h"

namespace ergodome {

//! Where a camera is and how it is turned, without a pole: Boyer-Lindquist coordinates as directions of a space that does not turn
//! (z along the spin axis). A pose changes by jumps where the camera goes over the axis; this does not.
struct CameraPlace {
  double r = 10.0;                      //!< [M]
  glm::dvec3 towards{1.0, 0.0, 0.0};    //!< unit vector from the hole to the camera
  glm::dquat view{1.0, 0.0, 0.0, 0.0};  //!< from the view's axes (x right, y up, z back) to the directions
};

CameraPlace place_of(const CameraPose& pose);

//! φ comes out between -π and π, and 0 on the axis.
CameraPose pose_of(const CameraPlace& place);

//! Unit vector to the east; any that is level on the axis.
glm::dvec3 east_at(const glm::dvec3& towards);

//! Moves a unit vector along a great circle: `step` is across it, in radians.
glm::dvec3 moved_on_sphere(const glm::dvec3& towards, const glm::dvec3& step);

//! Rotation by an axis times an angle [rad], and back: the short way round.
glm::dquat rotation(const glm::dvec3& turn);
glm::dvec3 turn_of(const glm::dquat& rotation);

//! The shortest rotation from one unit vector to another; about a level axis where they are opposite.
glm::dquat shortest_rotation(const glm::dvec3& from, const glm::dvec3& to);

}  // namespace ergodome
