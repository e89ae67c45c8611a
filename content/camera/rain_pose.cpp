#include "content/camera/rain_pose.h"

#include <cmath>

namespace ergodome {

namespace {

//! Converts a velocity from the ZAMO frame to the rain frame: the inverse of
//! ObserverMotion::rain_boost.
Vector3<double> rain_velocity(Spacetime spacetime, double r, double theta, const Vector3<double>& in_zamo) {
  const KerrFunctions f = kerr_functions(spacetime, r, theta);
  const double lapse = std::sqrt(f.sigma * f.delta / f.area);
  const double shared = 1.0 / (1.0 + f.rain_speed * in_zamo.x);
  return {shared * (in_zamo.x + f.rain_speed), shared * lapse * in_zamo.y, shared * lapse * in_zamo.z};
}

}  // namespace

glm::dquat rain_turn(Spacetime spacetime, double r, double theta, const Vector3<double>& in_zamo,
                     const Vector3<double>& in_rain) {
  const LorentzTransform turn = rain_axes_from_zamo_axes(spacetime, r, theta, in_zamo, in_rain);
  glm::dmat3 matrix;
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 3; ++column) {
      matrix[column][row] = turn.row[row + 1][column + 1];
    }
  }
  return glm::normalize(glm::quat_cast(matrix));
}

CameraPose in_zamo_frame(const CameraPose& pose, Spacetime spacetime) {
  if (!pose.velocity || !pose.velocity_in_rain || !(pose.r > horizon_radius(spacetime))) {
    return pose;
  }
  CameraPose other = pose;
  other.velocity = observer_velocity(ObserverMotion::rain_boost, spacetime, pose.r, pose.theta, *pose.velocity);
  other.velocity_in_rain = false;
  const glm::dquat turn = rain_turn(spacetime, pose.r, pose.theta, *other.velocity, *pose.velocity);
  other.orientation = glm::normalize(glm::conjugate(turn) * pose.orientation);
  return other;
}

CameraPose in_rain_frame(const CameraPose& pose, Spacetime spacetime) {
  if (!pose.velocity || pose.velocity_in_rain) {
    return pose;
  }
  CameraPose other = pose;
  other.velocity = rain_velocity(spacetime, pose.r, pose.theta, *pose.velocity);
  other.velocity_in_rain = true;
  other.orientation =
      glm::normalize(rain_turn(spacetime, pose.r, pose.theta, *pose.velocity, *other.velocity) * pose.orientation);
  return other;
}

}  // namespace ergodome
