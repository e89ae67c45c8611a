#include "render/passes/stars/search/view_cone.h"

#include <algorithm>
#include <cmath>

#include "kernels/core/angles.h"

namespace ergodome {

namespace {

//! Number of samples along the outline of a picture.
constexpr int outline_positions = 256;

//! Returns a direction on the outline of a picture: the rim of a fisheye, or the edges of other
//! pictures.
Vector3<double> outline_direction(const Projection& projection, int i) {
  const double x = 0.5 * projection.width_px;
  const double y = 0.5 * projection.height_px;
  const double turn = 2.0 * pi * i / outline_positions;
  double right = std::cos(turn);
  double down = std::sin(turn);
  if (projection.kind == ProjectionKind::dome_fisheye) {
    right *= projection.dome.lens.rim;
    down *= projection.dome.lens.rim;
  } else {
    // Goes from the unit circle to the edges of the square; the samples include the corners.
    const double out = 1.0 / std::max(std::abs(right), std::abs(down));
    right *= out;
    down *= out;
  }
  return direction_from_pixel(projection, x + right * x, y + down * y);
}

bool is_shown(const Projection& projection, const Vector3<double>& view) {
  double x_px = 0.0;
  double y_px = 0.0;
  return pixel_from_direction(projection, view, x_px, y_px) && x_px >= 0.0 && x_px <= projection.width_px &&
         y_px >= 0.0 && y_px <= projection.height_px && image_coverage(projection, x_px, y_px) > 0.0;
}

//! Returns the largest angle between a picture's center and any direction that the picture
//! contains.
double widest_angle(const Projection& projection, const Vector3<double>& middle) {
  if (projection.kind == ProjectionKind::dome_fisheye && projection.dome.off_centre == 0) {
    return projection.dome.lens.half_angle;
  }
  if (is_shown(projection, -middle)) {
    return pi;
  }
  double lowest = 1.0;
  double longest_step = 0.0;
  Vector3<double> before = outline_direction(projection, outline_positions - 1);
  for (int i = 0; i < outline_positions; ++i) {
    const Vector3<double> here = outline_direction(projection, i);
    lowest = std::min(lowest, dot(middle, here));
    longest_step = std::max(longest_step, std::acos(std::clamp(dot(before, here), -1.0, 1.0)));
    before = here;
  }
  return std::acos(std::clamp(lowest, -1.0, 1.0)) + 0.5 * longest_step;
}

}  // namespace

ViewCone view_cone(const EyeCamera& eye, const Projection& projection, double margin) {
  const Vector3<double> n = direction_from_pixel(projection, 0.5 * projection.width_px, 0.5 * projection.height_px);
  const auto row = [&](int i) {
    return eye.frame_from_view[i][0] * n.x + eye.frame_from_view[i][1] * n.y + eye.frame_from_view[i][2] * n.z;
  };
  ViewCone cone{{row(0), row(1), row(2)}};
  const bool whole_sky = wraps_around(projection) ||
                         (projection.kind == ProjectionKind::cube && projection.cube.layout != CubeLayout::face);
  if (!whole_sky) {
    cone.half_angle = widest_angle(projection, n);
    return widened(cone, margin);
  }
  return cone;
}

ViewCone widened(const ViewCone& view, double margin) {
  const double half_angle = view.half_angle + margin;
  return {view.axis, half_angle, std::cos(std::min(half_angle, pi))};
}

bool holds(const ViewCone& outer, const ViewCone& inner) {
  constexpr double rounding = 1e-6;
  const double apart = std::acos(std::clamp(dot(outer.axis, inner.axis), -1.0, 1.0));
  return outer.half_angle >= pi || outer.half_angle + rounding >= apart + inner.half_angle;
}

}  // namespace ergodome
