#pragma once

#include <glm/gtc/quaternion.hpp>

#include "content/camera/camera_path.h"

namespace ergodome {

//! rain_axes_from_zamo_axes() as a rotation of (e_r, e_θ, e_φ).
glm::dquat rain_turn(double spin, double r, double theta, const Vector3<double>& in_zamo,
                     const Vector3<double>& in_rain);

//! The same camera with its velocity in the ZAMO's frame, and axes that are boosted from there; one that moves otherwise, or is within the
//! horizon, as it is.
CameraPose in_zamo_frame(const CameraPose& pose, double spin);

//! The other way: of a camera outside the horizon that has a velocity.
CameraPose in_rain_frame(const CameraPose& pose, double spin);

}  // namespace ergodome
