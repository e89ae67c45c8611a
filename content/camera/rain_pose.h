#pragma once

#include <glm/gtc/quaternion.hpp>

#include "content/camera/camera_path.h"

namespace ergodome {

//! Returns the Wigner rotation from the axes of an observer boosted from the ZAMO frame to those of
//! the same observer boosted from the rain frame, in components along (e_r, e_θ, e_φ). `in_zamo`
//! and `in_rain` are its velocity in the two frames (rain_axes_from_zamo_axes()).
glm::dquat rain_turn(Spacetime spacetime, double r, double theta, const Vector3<double>& in_zamo,
                     const Vector3<double>& in_rain);

//! Returns the same camera with its velocity in the ZAMO frame and axes boosted from that frame.
//! Returns it unchanged if its velocity is not in the rain frame, or if it is inside the horizon.
CameraPose in_zamo_frame(const CameraPose& pose, Spacetime spacetime);

//! Converts a camera outside the horizon to the rain frame. Returns it unchanged if it has no
//! velocity, or a velocity that is already in the rain frame.
CameraPose in_rain_frame(const CameraPose& pose, Spacetime spacetime);

}  // namespace ergodome
