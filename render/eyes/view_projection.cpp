#include "render/eyes/view_projection.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "kernels/core/angles.h"
#include "kernels/core/error.h"
#include "kernels/projection/make_projection.h"

namespace ergodome {

namespace {

constexpr double largest_height_px = 16384.0;
//! Distance of an eye from the center of a dome, in radii of the dome, from which on
//! converged_projection() throws Error.
constexpr double nearest_convergence = 0.95;

//! Returns the height of a picture with square pixels [px], clamped to 1 ... 16384.
int height_for(int width_px, double width, double height) {
  return static_cast<int>(std::lround(std::clamp(width_px * height / width, 1.0, largest_height_px)));
}

Projection dome_projection(const ViewSettings& view, int width_px, double field_of_view) {
  DomeView dome;
  dome.law = view.lens;
  std::ranges::copy(view.polynomial, dome.coefficient);
  dome.field_of_view = std::min(field_of_view, 2.0 * largest_half_angle(dome.law, dome.coefficient));
  dome.tilt = one_degree * view.tilt_deg;
  dome.viewer = view.viewer;
  dome.cut_below = view.truncation.bottom;
  dome.cut_above = view.truncation.top;
  return make_dome_projection(width_px, dome);
}

Projection equirect_projection(const ViewSettings& view, int width_px) {
  if (shows_whole_sky(view)) {
    return make_equirectangular_projection(width_px, std::max(width_px / 2, 1));
  }
  const double azimuth = one_degree * view.field_of_view_deg;
  return make_equirectangular_projection(width_px, height_for(width_px, azimuth, pi), azimuth);
}

Projection cube_projection(CubeFiles files, int width_px) {
  switch (files) {
    case CubeFiles::cross:
      return make_cube_projection(std::max(width_px / 4, 1), CubeLayout::cross);
    case CubeFiles::strip:
      return make_cube_projection(std::max(width_px / cube_faces, 1), CubeLayout::strip);
    case CubeFiles::faces:
      break;
  }
  return make_cube_projection(width_px, CubeLayout::strip);
}

Projection cylinder_projection(const ViewSettings& view, int width_px) {
  const double azimuth = one_degree * view.field_of_view_deg;
  const double highest = std::tan(0.5 * one_degree * view.height_deg);
  return make_cylinder_projection(width_px, height_for(width_px, azimuth, 2.0 * highest), azimuth, -highest, highest);
}

Projection frustum_projection(const FrustumAngles& angles, int width_px) {
  const auto tangent = [](double angle_deg) { return std::tan(one_degree * angle_deg); };
  const FrustumSides sides = {tangent(angles.left_deg), tangent(angles.right_deg), tangent(angles.up_deg),
                              tangent(angles.down_deg)};
  return make_frustum_projection(width_px, height_for(width_px, sides.right - sides.left, sides.up - sides.down),
                                 sides);
}

Projection inside_projection(const ViewSettings& view, int width_px, double field_of_view) {
  switch (view.projection) {
    case ViewProjection::equirect:
      return equirect_projection(view, width_px);
    case ViewProjection::cube:
      return cube_projection(view.cube_files, width_px);
    case ViewProjection::cylinder:
      return cylinder_projection(view, width_px);
    case ViewProjection::pinhole:
      return view.frustum ? frustum_projection(*view.frustum, width_px)
                          : make_pinhole_projection(width_px, height_for(width_px, view.aspect, 1.0), field_of_view);
    case ViewProjection::dome:
      break;
  }
  return dome_projection(view, width_px, field_of_view);
}

}  // namespace

Projection make_projection(const ViewSettings& view, int width_px, double field_of_view_deg) {
  const double field_of_view = one_degree * (field_of_view_deg > 0.0 ? field_of_view_deg : view.field_of_view_deg);
  const Projection inside = inside_projection(view, width_px, field_of_view);
  return view.from_outside ? seen_from_outside(inside) : inside;
}

Projection converged_projection(const Projection& projection, double offset, double convergence) {
  if (!(convergence > 0.0) || offset == 0.0) {
    return projection;
  }
  Projection turned = projection;
  const double slope = offset / convergence;
  if (projection.kind == ProjectionKind::pinhole) {
    turned.pinhole.middle_x -= slope;
  } else if (projection.kind == ProjectionKind::dome_fisheye) {
    turned.dome.viewer.x += slope;
    turned.dome.off_centre = 1;
    if (!(dot(turned.dome.viewer, turned.dome.viewer) < nearest_convergence * nearest_convergence)) {
      throw Error("stereo.convergence",
                  fmt::format("a convergence distance of {:.6g} M is too small for a baseline of {:.6g} M on a dome",
                              convergence, 2.0 * std::abs(offset)),
                  "choose a larger convergence distance, or a smaller baseline");
    }
  }
  return turned;
}

}  // namespace ergodome
