#include "render/eyes/eye_camera.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/gtc/quaternion.hpp>

#include "kernels/core/error.h"
#include "render/eyes/stereo_rig.h"

namespace ergodome {

namespace {

//! Sets an eye's motion. All eyes of a head have the same velocity in the ZAMO frame: that of the
//! observer at the head's position. Rain and ZAMO observers are defined at each eye's own position
//! instead, and eyes of an infalling head have the same velocity in the rain frame. Throws Error if
//! the observer would not be slower than light.
void set_motion(EyeCamera& eye, const Show& show, const CameraPose& pose) {
  if (pose.velocity && pose.velocity_in_rain) {
    eye.motion = ObserverMotion::rain_boost;
    eye.velocity = *pose.velocity;
    return;
  }
  eye.motion = pose.velocity ? ObserverMotion::velocity : show.camera.motion;
  eye.velocity = pose.velocity.value_or(show.camera.velocity);
  if (eye.motion == ObserverMotion::rain || eye.motion == ObserverMotion::zamo) {
    return;
  }
  eye.velocity = observer_velocity(eye.motion, spacetime_of(show), pose.r, pose.theta, eye.velocity);
  eye.motion = ObserverMotion::velocity;
  if (!(dot(eye.velocity, eye.velocity) < 1.0)) {
    throw Error(show.name, fmt::format("the chosen observer cannot exist at r = {:.6g} M", pose.r),
                "choose observer = \"zamo\" or a camera path farther out");
  }
}

}  // namespace

EyeCamera eye_camera(const Show& show, const CameraPose& pose, const Vector3<double>& offset) {
  const Spacetime spacetime = spacetime_of(show);
  const double horizon = horizon_radius(spacetime);
  const bool in_rain = pose.velocity && pose.velocity_in_rain;
  const double deepest = in_rain ? std::min(min_interior_radius(spacetime), horizon) : horizon;
  if (!(pose.r > deepest)) {
    throw Error(show.name, fmt::format("the camera is too close to the hole (r = {:.6g} M)", pose.r),
                fmt::format("keep it farther out than r = {:.6g} M", deepest));
  }
  if (!std::isfinite(pose.r + pose.theta + pose.phi + offset.x + offset.y + offset.z)) {
    throw Error(show.name, "the camera position or an eye offset is not finite", "choose another camera position");
  }
  const glm::dmat3 turn = glm::mat3_cast(pose.orientation);
  double head[3][3];
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) {
      head[i][j] = turn[j][i];
    }
  }
  // An eye that would be inside the hole is moved out to just outside the horizon; an eye of an
  // infalling head only to just outside min_interior_radius().
  const EyeEvent event =
      eye_event(spacetime, pose.r, pose.theta, pose.phi, head, offset, {deepest + 1e-3 * (pose.r - deepest), in_rain});
  EyeCamera eye{};
  eye.spacetime = spacetime;
  // An eye at the head's position gets exactly the head's r and θ, so that it equals a single
  // camera.
  constexpr double rounding = 1e-12;
  const auto unless_rounding = [](double of_eye, double of_head) {
    return std::abs(of_eye - of_head) <= rounding * of_head ? of_head : of_eye;
  };
  eye.r = unless_rounding(event.r, pose.r);
  eye.theta = unless_rounding(event.theta, pose.theta);
  eye.phi = event.phi;
  eye.head_r = pose.r;
  eye.head_theta = pose.theta;
  eye.clock_lead = pose.clock_lead;
  if (in_rain) {
    eye.clock_lead += outer_lag(spacetime, eye.r) - outer_lag(spacetime, pose.r);
  }
  set_motion(eye, show, pose);
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) {
      eye.frame_from_view[i][j] = event.frame_from_view[i][j];
    }
  }
  return eye;
}

Vector3<double> position_of(const EyeCamera& eye) {
  return {eye.r * std::sin(eye.theta) * std::cos(eye.phi), eye.r * std::sin(eye.theta) * std::sin(eye.phi),
          eye.r * std::cos(eye.theta)};
}

}  // namespace ergodome
