#include <cmath>

#include "content/camera/camera_path.h"

namespace ergodome {

glm::dquat spherical_frame(double theta, double phi) {
  const double st = std::sin(theta);
  const double ct = std::cos(theta);
  const double sp = std::sin(phi);
  const double cp = std::cos(phi);
  return glm::normalize(glm::quat_cast(glm::dmat3(st * cp, st * sp, ct, ct * cp, ct * sp, -st, -sp, cp, 0.0)));
}

glm::dquat key_orientation(const CameraKey& key) {
  glm::dvec3 forward(-1.0, 0.0, 0.0);
  if (key.look.kind == LookTarget::Kind::away) {
    forward = -forward;
  } else if (key.look.kind == LookTarget::Kind::direction) {
    forward = glm::normalize(glm::dvec3(key.look.direction.x, key.look.direction.y, key.look.direction.z));
  }
  const glm::dvec3 north(0.0, -1.0, 0.0);
  const glm::dvec3 across = glm::cross(forward, north);
  // Looking along e_θ or -e_θ, "up" toward the spin axis is undefined. Right is then e_φ, and up is
  // -e_r or e_r.
  const glm::dvec3 right = glm::length(across) > 1e-9 ? glm::normalize(across) : glm::dvec3(0.0, 0.0, 1.0);
  const glm::dvec3 up = glm::cross(right, forward);
  const glm::dquat look = glm::quat_cast(glm::dmat3(right, up, -forward));
  const glm::dquat yaw = glm::angleAxis(-key.yaw, glm::dvec3(0.0, 1.0, 0.0));
  const glm::dquat pitch = glm::angleAxis(key.pitch, glm::dvec3(1.0, 0.0, 0.0));
  const glm::dquat roll = glm::angleAxis(-key.roll, glm::dvec3(0.0, 0.0, 1.0));
  return glm::normalize(look * yaw * pitch * roll);
}

}  // namespace ergodome
