#include "render/diagram/light_curve.h"

#include <algorithm>
#include <cmath>

#include "kernels/spacetime/schwarzschild/apparent_position.h"
#include "kernels/spacetime/schwarzschild/ray_curve.h"

namespace ergodome {

namespace {

//! Maximum angle around the hole between adjacent points of a curve [rad].
constexpr double finest_turn = 0.03;
constexpr int min_pieces = 32;

}  // namespace

std::vector<Vector3<double>> light_curve(const Vector3<double>& observer, const Vector3<double>& point, int order) {
  const ConnectionPlane plane = connection_plane(observer, point);
  const double angle = image_angle(plane.phi, order);
  if (why_not_connected(plane.r_observer, plane.r, angle) != nullptr) {
    return {};
  }
  const ConnectingRay ray = connecting_ray(plane.r_observer, plane.r, angle);
  const int half = std::max(min_pieces, static_cast<int>(std::ceil(angle / finest_turn))) / 2 + 1;
  const double step = 0.5 / half;
  const double side = order % 2 == 1 ? 1.0 : -1.0;
  const auto position = [&](const RayPosition& at) {
    const double phi = at.share * angle;
    return (1.0 / at.u) * (std::cos(phi) * plane.outward + side * std::sin(phi) * plane.across);
  };
  RayPosition from_point = position_at_point(ray, plane.r_observer, plane.r, angle);
  RayPosition from_observer = position_at_observer(ray, plane.r_observer, plane.r, angle);
  std::vector<Vector3<double>> first = {position(from_point)};
  std::vector<Vector3<double>> last = {position(from_observer)};
  for (int i = 0; i < half; ++i) {
    from_point = moved_on(from_point, angle, -step);
    first.push_back(position(from_point));
    from_observer = moved_on(from_observer, angle, step);
    last.push_back(position(from_observer));
  }
  // Both halves of the curve end at the point where they meet, which must appear once.
  first.insert(first.end(), last.rbegin() + 1, last.rend());
  return first;
}

}  // namespace ergodome
