#include "render/present/headset/head_motion.h"

#include <algorithm>
#include <cmath>

#include "render/eyes/eye_camera.h"
#include "render/stereo/eye_distance.h"

namespace ergodome {

double scale_per_meter(const HeadsetSettings& settings, double r, double horizon_radius) {
  constexpr double share_of_distance = 0.1;
  constexpr double min_share_of_r = 0.01;
  if (settings.scale > 0.0 && std::isfinite(settings.scale)) {
    return settings.scale;
  }
  if (!std::isfinite(r) || !std::isfinite(horizon_radius) || !(r > 0.0)) {
    return 0.0;
  }
  return std::max(share_of_distance * (r - horizon_radius), min_share_of_r * r);
}

double max_head_offset(Spacetime spacetime, const CameraPose& pose) {
  const double room = 0.5 * omni_room(spacetime, pose);
  return std::isfinite(room) ? std::max(room, 0.0) : 0.0;
}

Vector3<double> limited_head_offset(const Vector3<double>& offset, double maximum) {
  // Larger numbers would overflow in the length.
  const auto number = [](double value) {
    constexpr double largest = 1e100;
    return std::isnan(value) ? 0.0 : std::clamp(value, -largest, largest);
  };
  const Vector3<double> v = {number(offset.x), number(offset.y), number(offset.z)};
  const double length = std::sqrt(dot(v, v));
  const double allowed = maximum > 0.0 ? maximum : 0.0;
  return length > allowed ? (allowed / length) * v : v;
}

CameraPose moved_head(const Show& show, const CameraPose& pose, const Vector3<double>& offset) {
  const EyeCamera eye = eye_camera(show, pose, limited_head_offset(offset, max_head_offset(spacetime_of(show), pose)));
  glm::dmat3 turn;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) {
      turn[j][i] = eye.frame_from_view[i][j];
    }
  }
  CameraPose moved = pose;
  moved.r = eye.r;
  moved.theta = eye.theta;
  moved.phi = eye.phi;
  moved.orientation = glm::normalize(glm::quat_cast(turn));
  moved.clock_lead = eye.clock_lead;
  if (eye.motion == ObserverMotion::velocity) {
    moved.velocity = eye.velocity;
  }
  return moved;
}

}  // namespace ergodome
