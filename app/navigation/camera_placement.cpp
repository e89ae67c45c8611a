#include "app/navigation/camera_placement.h"

#include <cmath>

namespace ergodome {

namespace {
constexpr glm::dvec3 spin_axis(0.0, 0.0, 1.0);
}  // namespace

CameraPlacement placement_of(const CameraPose& pose) {
  const double st = std::sin(pose.theta);
  return {pose.r,
          {st * std::cos(pose.phi), st * std::sin(pose.phi), std::cos(pose.theta)},
          glm::normalize(spherical_frame(pose.theta, pose.phi) * pose.orientation)};
}

CameraPose pose_of(const CameraPlacement& placement) {
  const glm::dvec3& n = placement.towards;
  const double across = std::hypot(n.x, n.y);
  const double theta = std::atan2(across, n.z);
  const double phi = across > 0.0 ? std::atan2(n.y, n.x) : 0.0;
  return {placement.r, theta, phi, glm::normalize(glm::conjugate(spherical_frame(theta, phi)) * placement.view)};
}

glm::dvec3 east_at(const glm::dvec3& towards) {
  const glm::dvec3 east = glm::cross(spin_axis, towards);
  const double sine = glm::length(east);
  return sine > 1e-150 ? east / sine : glm::dvec3(0.0, 1.0, 0.0);
}

glm::dvec3 moved_on_sphere(const glm::dvec3& towards, const glm::dvec3& step) {
  const double angle = glm::length(step);
  if (!(angle > 0.0)) {
    return towards;
  }
  return glm::normalize(std::cos(angle) * towards + (std::sin(angle) / angle) * step);
}

glm::dquat rotation(const glm::dvec3& turn) {
  const double half = 0.5 * glm::length(turn);
  const double factor = half > 1e-12 ? 0.5 * std::sin(half) / half : 0.5;
  return {std::cos(half), factor * turn.x, factor * turn.y, factor * turn.z};
}

glm::dvec3 turn_of(const glm::dquat& rotation) {
  const glm::dquat q = rotation.w < 0.0 ? -rotation : rotation;
  const glm::dvec3 v(q.x, q.y, q.z);
  const double sine = glm::length(v);
  return sine > 0.0 ? v * (2.0 * std::atan2(sine, q.w) / sine) : glm::dvec3(0.0);
}

glm::dquat shortest_rotation(const glm::dvec3& from, const glm::dvec3& to) {
  const glm::dvec3 axis = glm::cross(from, to);
  const double sine = glm::length(axis);
  const double angle = std::atan2(sine, glm::dot(from, to));
  return rotation(angle * (sine > 1e-12 ? axis / sine : east_at(from)));
}

}  // namespace ergodome
