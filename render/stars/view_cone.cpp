#include "render/stars/view_cone.h"

#include <cmath>

namespace ergodome {

ViewCone view_cone(const EyeCamera& eye, const Projection& projection, double margin) {
  const Vector3<double> n = direction_from_pixel(projection, 0.5 * projection.width_px, 0.5 * projection.height_px);
  const auto row = [&](int i) {
    return eye.frame_from_view[i][0] * n.x + eye.frame_from_view[i][1] * n.y + eye.frame_from_view[i][2] * n.z;
  };
  ViewCone cone{{row(0), row(1), row(2)}};
  if (projection.kind == ProjectionKind::dome_fisheye) {
    cone.half_angle = projection.dome.half_angle + margin;
  } else if (projection.kind == ProjectionKind::pinhole) {
    cone.half_angle = std::atan(std::hypot(projection.pinhole.half_width, projection.pinhole.half_height)) + margin;
  }
  return cone;
}

bool may_touch(const ViewCone& view, const Vector3<double>& axis, double radius) {
  const double reach = view.half_angle + radius;
  return reach >= 3.14159265358979323846 || dot(view.axis, axis) >= std::cos(reach);
}

}  // namespace ergodome
