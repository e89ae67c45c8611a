#include "render/passes/stars/search/sky_frustum.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "kernels/core/angles.h"
#include "kernels/spacetime/shadow/shadow_chart.h"
#include "kernels/stars/search/patch_motion.h"

namespace ergodome {

namespace {

//! Returns the direction perpendicular to `axis` in which a patch is longer: along u or along v.
Vector3<double> long_way(const BezierPatch& patch, const Vector3<double>& axis) {
  const auto from_to = [&](int a, int b, int c, int d) {
    const Vector3<double> way = 0.5 * (control_point(patch, b) - control_point(patch, a)) +
                                0.5 * (control_point(patch, d) - control_point(patch, c));
    return way - dot(way, axis) * axis;
  };
  const Vector3<double> along_u = from_to(0, 3, 12, 15);
  const Vector3<double> along_v = from_to(0, 12, 3, 15);
  return dot(along_u, along_u) > dot(along_v, along_v) ? along_u : along_v;
}

//! Margin of the bounds, for rounding errors of float.
constexpr double bound_slack = 1e-6;

//! Computes the corners of a frustum on the sky, in order around it.
void find_corners(const SkyFrustum& frustum, Vector3<double> (&corner)[4]) {
  // Sides 0 and 1 are opposite each other, as are 2 and 3.
  constexpr int around[4] = {0, 2, 1, 3};
  for (int i = 0; i < 4; ++i) {
    const Vector3<double> way = normalized(cross(frustum.inward[around[i]], frustum.inward[around[(i + 1) % 4]]));
    corner[i] = (dot(way, frustum.inward[4]) < 0.0 ? -1.0 : 1.0) * way;
  }
}

//! Returns the largest z on the arc between two directions: that of an end or of the highest point
//! of the great circle, whose unit normal is `normal`.
double max_height(const Vector3<double>& from, const Vector3<double>& to, const Vector3<double>& normal) {
  const double corner = std::max(from.z, to.z);
  // The circle's highest point lies along z minus its component along the normal.
  const Vector3<double> highest = Vector3<double>{0.0, 0.0, 1.0} - normal.z * normal;
  const bool between =
      dot(cross(from, highest), normal) * dot(cross(highest, to), normal) > 0.0 && dot(highest, from + to) > 0.0;
  return between ? std::max(corner, std::sqrt(std::max(dot(highest, highest), 0.0))) : corner;
}

//! Returns whether a frustum contains a pole or is next to it.
bool holds_pole(const SkyFrustum& frustum, double pole) {
  return std::ranges::all_of(frustum.inward, [&](const Vector3<double>& n) { return pole * n.z > -bound_slack; });
}

}  // namespace

PatchFrame frame_of(const BezierPatch& patch, const Vector3<double>& axis) {
  Vector3<double> first = long_way(patch, axis);
  if (!(dot(first, first) > 1e-20)) {
    first = cross(std::abs(axis.z) < 0.9 ? Vector3<double>{0.0, 0.0, 1.0} : Vector3<double>{1.0, 0.0, 0.0}, axis);
  }
  first = normalized(first);
  return {first, cross(axis, first), axis};
}

BezierPatch in_frame(const BezierPatch& patch, const PatchFrame& frame) {
  BezierPatch own{};
  for (int i = 0; i < 16; ++i) {
    const Vector3<double> p = control_point(patch, i);
    own.x[i] = static_cast<float>(dot(p, frame.first));
    own.y[i] = static_cast<float>(dot(p, frame.second));
    own.z[i] = static_cast<float>(dot(p, frame.axis));
  }
  return own;
}

SkyFrustum frustum_of(const BezierPatch& patch, const PatchFrame& frame, double error) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  double low[2] = {infinity, infinity};
  double high[2] = {-infinity, -infinity};
  for (int i = 0; i < 16; ++i) {
    const Vector3<double> p = control_point(patch, i);
    const double position[2] = {p.x / p.z, p.y / p.z};
    for (int side = 0; side < 2; ++side) {
      low[side] = std::min(low[side], position[side]);
      high[side] = std::max(high[side], position[side]);
    }
  }
  const auto inward = [&](const Vector3<double>& way, double sign, double position) {
    return normalized(sign * (way - position * frame.axis));
  };
  const auto margin = [&](double size) {
    return static_cast<double>(part_slack) * size + static_cast<double>(min_part_slack) + error;
  };
  const double wider[2] = {margin(high[0] - low[0]), margin(high[1] - low[1])};
  return {{inward(frame.first, 1.0, low[0] - wider[0]), inward(frame.first, -1.0, high[0] + wider[0]),
           inward(frame.second, 1.0, low[1] - wider[1]), inward(frame.second, -1.0, high[1] + wider[1]), frame.axis}};
}

SkyBounds bounds_of(const SkyFrustum& frustum) {
  Vector3<double> corner[4];
  find_corners(frustum, corner);
  constexpr int side[4] = {2, 1, 3, 0};
  double low = 1.0;
  double high = -1.0;
  double min_turns = 1.0;
  double max_turns = -1.0;
  const double middle = std::atan2(frustum.inward[4].y, frustum.inward[4].x);
  for (int i = 0; i < 4; ++i) {
    const Vector3<double>& from = corner[i];
    const Vector3<double>& to = corner[(i + 1) % 4];
    high = std::max(high, max_height(from, to, frustum.inward[side[i]]));
    low = std::min(low, -max_height(-from, -to, frustum.inward[side[i]]));
    const double turns = std::remainder(std::atan2(from.y, from.x) - middle, 2.0 * pi) / (2.0 * pi);
    min_turns = std::min(min_turns, turns);
    max_turns = std::max(max_turns, turns);
  }
  const bool north = holds_pole(frustum, 1.0);
  const bool south = holds_pole(frustum, -1.0);
  SkyBounds bounds{static_cast<float>(south ? -1.0 : low - bound_slack),
                   static_cast<float>(north ? 1.0 : high + bound_slack), 0.0F, 1.0F};
  // Beside a pole, a small part of the sky may span most azimuths. Spans of more than half a turn
  // are replaced by the full turn.
  if (!north && !south && max_turns - min_turns < 0.5) {
    const double begin = middle / (2.0 * pi) + min_turns - bound_slack;
    bounds.turns = static_cast<float>(begin - std::floor(begin));
    bounds.width_turns = static_cast<float>(max_turns - min_turns + 2.0 * bound_slack);
  }
  return bounds;
}

double solid_angle(const SkyFrustum& frustum) {
  // Opposite sides of a frustum form a wedge. If its opening angle is a, the normals of the sides
  // enclose the angle π - a.
  const auto opening = [&](int side) {
    const double cosine = dot(frustum.inward[side], frustum.inward[side + 1]);
    return pi - std::acos(std::clamp(cosine, -1.0, 1.0));
  };
  return opening(0) * opening(2);
}

SkyPart sky_part(const SkyFrustum& frustum) {
  SkyPart part{};
  for (int side = 0; side < 4; ++side) {
    const Vector3<double>& inward = frustum.inward[side];
    part.inward[side][0] = static_cast<float>(inward.x);
    part.inward[side][1] = static_cast<float>(inward.y);
    part.inward[side][2] = static_cast<float>(inward.z);
  }
  part.bounds = bounds_of(frustum);
  return part;
}

SkyRotation sky_rotation(double phi) {
  const double turns = phi / (2.0 * pi);
  return {static_cast<float>(turns - std::floor(turns)), std::sin(phi), std::cos(phi)};
}

}  // namespace ergodome
