#pragma once

#include <cstdint>

#include "kernels/projection/cube_faces.h"
#include "kernels/projection/cylinder.h"
#include "kernels/projection/dome_fisheye.h"
#include "kernels/projection/equirectangular.h"
#include "kernels/projection/pinhole.h"

// Projections of all kinds: from pixel to view direction and back.
namespace ergodome {

//! Kinds of map from the sky to an image.
enum class ProjectionKind : std::int32_t { dome_fisheye, equirectangular, cube, cylinder, pinhole };

//! A projection with its image size; only the parameters of its `kind` are used.
template <class S>
struct ProjectionOf {
  ProjectionKind kind;
  int width_px;
  int height_px;
  S left;  //!< x of the left side: -1, or 1 for a mirror image (as seen from outside)
  DomeFisheye<S> dome;
  Equirectangular<S> equirectangular;
  CubePicture cube;
  Cylinder<S> cylinder;
  Pinhole<S> pinhole;
};

using Projection = ProjectionOf<double>;

inline namespace ERGO_TARGET {

//! Converts a projection to the precision of a kernel.
template <class S>
ERGO_HD ProjectionOf<S> converted_projection(const Projection& p) {
  return {p.kind,
          p.width_px,
          p.height_px,
          static_cast<S>(p.left),
          converted_dome<S>(p.dome),
          {static_cast<S>(p.equirectangular.half_azimuth)},
          p.cube,
          {static_cast<S>(p.cylinder.half_azimuth), static_cast<S>(p.cylinder.middle_height),
           static_cast<S>(p.cylinder.half_height)},
          {static_cast<S>(p.pinhole.half_width), static_cast<S>(p.pinhole.half_height),
           static_cast<S>(p.pinhole.middle_x), static_cast<S>(p.pinhole.middle_y)}};
}

//! Converts a pixel position to an image position (x, y): -1 to 1 across width and height, y up, x
//! to the right for a viewer inside.
template <class T>
ERGO_HD void image_position(const ProjectionOf<ScalarOf<T>>& projection, const T& x_px, const T& y_px, T& x, T& y) {
  using S = ScalarOf<T>;
  x = x_px * (projection.left * (S(-2) / static_cast<S>(projection.width_px))) + projection.left;
  y = S(1) - y_px * (S(2) / static_cast<S>(projection.height_px));
}

namespace detail {
//! Returns the view direction at an image position, for any projection.
template <class T>
ERGO_HD_RARE Vector3<T> direction_from_position(const ProjectionOf<ScalarOf<T>>& projection, const T& x, const T& y) {
  switch (projection.kind) {
    case ProjectionKind::dome_fisheye:
      return direction_from_fisheye(projection.dome, x, y);
    case ProjectionKind::equirectangular:
      return direction_from_equirectangular(projection.equirectangular, x, y);
    case ProjectionKind::cube:
      return direction_from_cube(projection.cube, x, y);
    case ProjectionKind::cylinder:
      return direction_from_cylinder(projection.cylinder, x, y);
    case ProjectionKind::pinhole:
      break;
  }
  return direction_from_pinhole(projection.pinhole, x, y);
}
}  // namespace detail

//! Returns the view direction (x right, y up, z back; unit length) at a pixel position: (0.5, 0.5)
//! is the center of the top left pixel.
//!
//! With dual numbers that carry d/dx_px and d/dy_px (y downwards), the result carries the exact
//! derivatives per pixel.
template <class T>
ERGO_HD Vector3<T> direction_from_pixel(const ProjectionOf<ScalarOf<T>>& projection, const T& x_px, const T& y_px) {
  T x;
  T y;
  image_position(projection, x_px, y_px, x, y);
  if (projection.kind == ProjectionKind::dome_fisheye && is_plain(projection.dome)) {
    return direction_from_plain_fisheye(projection.dome, x, y);
  }
  return detail::direction_from_position(projection, x, y);
}

//! Computes the pixel position of a view direction: the inverse of direction_from_pixel(). Returns
//! false where no pixel shows the direction: beside and behind a flat screen or a single cube face,
//! straight up and down for a cylinder, beyond the end of a lens law.
ERGO_HD bool pixel_from_direction(const Projection& projection, const Vector3<double>& view, double& x_px,
                                  double& y_px) {
  double x = 0.0;
  double y = 0.0;
  bool exists = true;
  switch (projection.kind) {
    case ProjectionKind::dome_fisheye:
      exists = fisheye_from_direction(projection.dome, view, x, y);
      break;
    case ProjectionKind::equirectangular:
      equirectangular_from_direction(projection.equirectangular, view, x, y);
      break;
    case ProjectionKind::cube:
      exists = cube_from_direction(projection.cube, view, x, y);
      break;
    case ProjectionKind::cylinder:
      exists = cylinder_from_direction(projection.cylinder, view, x, y);
      break;
    case ProjectionKind::pinhole:
      exists = pinhole_from_direction(projection.pinhole, view, x, y);
      break;
  }
  x_px = 0.5 * (1.0 - projection.left * x) * projection.width_px;
  y_px = 0.5 * (1.0 - y) * projection.height_px;
  return exists;
}

//! Returns the fraction of a pixel that the image covers: 1, except that it falls to 0 across the
//! rim and the cuts of a fisheye, and is 0 beside a cube's faces. Pixels with coverage 0 are black
//! and are not traced.
template <class T>
ERGO_HD T image_coverage(const ProjectionOf<ScalarOf<T>>& projection, const T& x_px, const T& y_px) {
  using S = ScalarOf<T>;
  if (projection.kind == ProjectionKind::dome_fisheye) {
    const S half_width = S(0.5) * static_cast<S>(projection.width_px);
    return fisheye_coverage<T>(projection.dome, half_width, x_px - half_width,
                               y_px - S(0.5) * static_cast<S>(projection.height_px));
  }
  if (projection.kind == ProjectionKind::cube) {
    T x;
    T y;
    image_position(projection, x_px, y_px, x, y);
    return cube_coverage(projection.cube, x, y);
  }
  return T(S(1));
}

//! Returns whether the right side of the image is adjacent to the left side on the sky.
template <class S>
ERGO_HD bool wraps_around(const ProjectionOf<S>& projection) {
  constexpr S almost_half_turn = S(3.1415926);
  return (projection.kind == ProjectionKind::equirectangular &&
          projection.equirectangular.half_azimuth > almost_half_turn) ||
         (projection.kind == ProjectionKind::cylinder && projection.cylinder.half_azimuth > almost_half_turn);
}

}  // namespace ERGO_TARGET
}  // namespace ergodome
