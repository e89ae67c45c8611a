#include "render/diagram/outside_camera.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "kernels/core/angles.h"

namespace ergodome {

namespace {

//! Half the vertical field of view [rad]: small, for little perspective, as in drawings.
constexpr double half_view = 13.0 * one_degree;
//! Fraction of the picture that stays free around the subject.
constexpr double picture_margin = 0.04;

//! Maxima over all positions of linear combinations such as p.x + tangent · p.z. Each is the
//! constraint that one side of the frustum puts on the camera's position. `nearest` and `farthest`
//! are the maximum and minimum of p.z.
struct FrustumBounds {
  double right = -std::numeric_limits<double>::max();
  double left = right;
  double up = right;
  double down = right;
  double nearest = right;
  double farthest = std::numeric_limits<double>::max();
};

}  // namespace

OutsideCamera outside_camera(const OutsideDirection& direction, const std::vector<Vector3<double>>& positions,
                             double aspect, const PictureBand& band) {
  const double sine = std::sin(direction.elevation);
  const double cosine = std::cos(direction.elevation);
  const double sine_azimuth = std::sin(direction.azimuth);
  const double cosine_azimuth = std::cos(direction.azimuth);
  OutsideCamera camera{};
  camera.back = {cosine * cosine_azimuth, cosine * sine_azimuth, sine};
  camera.right = {-sine_azimuth, cosine_azimuth, 0.0};
  camera.up = cross(camera.back, camera.right);
  camera.half_height = std::tan(half_view);
  camera.half_width = camera.half_height * aspect;
  const double tangent = camera.half_width * (1.0 - picture_margin);
  const double tangent_up = camera.half_height * (2.0 * band.high - 1.0 - picture_margin);
  const double tangent_down = camera.half_height * (1.0 - 2.0 * band.low - picture_margin);
  FrustumBounds bounds;
  for (const Vector3<double>& p : positions) {
    const Vector3<double> at = camera.in_view(p);  // relative to the origin, because the position is not set yet
    bounds.right = std::max(bounds.right, at.x + tangent * at.z);
    bounds.left = std::max(bounds.left, -at.x + tangent * at.z);
    bounds.up = std::max(bounds.up, at.y + tangent_up * at.z);
    bounds.down = std::max(bounds.down, -at.y + tangent_down * at.z);
    bounds.nearest = std::max(bounds.nearest, at.z);
    bounds.farthest = std::min(bounds.farthest, at.z);
  }
  // A position is in the picture if |x - x_c| <= tangent (z_c - z), where c is the camera: left and
  // right sides give bounds of z_c, and so do top and bottom.
  double z =
      std::max(0.5 * (bounds.right + bounds.left) / tangent, (bounds.up + bounds.down) / (tangent_up + tangent_down));
  double x = 0.5 * (bounds.right - bounds.left);
  double y = 0.5 * (bounds.up - tangent_up * z - bounds.down + tangent_down * z);
  if (direction.distance) {
    const double middle = 0.5 * (bounds.nearest + bounds.farthest);
    z = middle + *direction.distance;
    x = 0.5 * (bounds.right - bounds.left);
    y = 0.5 * (bounds.up - tangent_up * z - bounds.down + tangent_down * z);
  }
  camera.position = x * camera.right + y * camera.up + z * camera.back;
  const double depth = bounds.nearest - bounds.farthest;
  camera.nearest = std::max(z - bounds.nearest - depth, 1e-3 * depth);
  camera.farthest = std::max(z - bounds.farthest + 2.0 * depth, 2.0 * camera.nearest);
  return camera;
}

std::vector<Vector3<double>> sphere_outline(double radius, const OutsideCamera& camera) {
  constexpr int sides = 180;
  const double distance = std::sqrt(dot(camera.position, camera.position));
  std::vector<Vector3<double>> circle;
  if (!(distance > radius)) {
    return circle;
  }
  const Vector3<double> toward = (1.0 / distance) * camera.position;
  Vector3<double> across = camera.up - dot(camera.up, toward) * toward;
  across = (1.0 / std::sqrt(dot(across, across))) * across;
  const Vector3<double> beside = cross(across, toward);
  const double ahead = radius * radius / distance;
  const double own = radius * std::sqrt(1.0 - radius * radius / (distance * distance));
  for (int i = 0; i <= sides; ++i) {
    const double angle = full_turn * i / sides;
    circle.push_back(ahead * toward + own * (std::cos(angle) * across + std::sin(angle) * beside));
  }
  return circle;
}

}  // namespace ergodome
