#pragma once

#include <glm/gtc/quaternion.hpp>

#include "content/camera/camera_path.h"

namespace ergodome {

//! Position and orientation of a camera without a coordinate pole: Boyer-Lindquist coordinates as
//! directions in a non-rotating space (z along the spin axis). Continuous where the camera crosses
//! the axis, unlike a pose.
struct CameraPlacement {
  double r = 10.0;                    //!< Boyer-Lindquist radius [M]
  glm::dvec3 towards{1.0, 0.0, 0.0};  //!< unit vector from the hole to the camera
  //! Rotation from the view's axes (x right, y up, z back) to the non-rotating space with z along
  //! the spin axis.
  glm::dquat view{1.0, 0.0, 0.0, 0.0};
};

CameraPlacement placement_of(const CameraPose& pose);

//! Returns the pose with φ in [-π, π]; on the spin axis, φ is 0.
CameraPose pose_of(const CameraPlacement& placement);

//! Returns the unit vector to the east; on the spin axis, +y.
glm::dvec3 east_at(const glm::dvec3& towards);

//! Moves a unit vector along a great circle by `step`, a perpendicular vector in radians.
glm::dvec3 moved_on_sphere(const glm::dvec3& towards, const glm::dvec3& step);

//! rotation() converts an axis times an angle [rad] to a rotation. turn_of() converts a rotation
//! back, to an angle of at most half a turn.
glm::dquat rotation(const glm::dvec3& turn);
glm::dvec3 turn_of(const glm::dquat& rotation);

//! Returns the shortest rotation from one unit vector to another; about a horizontal axis if they
//! are opposite.
glm::dquat shortest_rotation(const glm::dvec3& from, const glm::dvec3& to);

}  // namespace ergodome
