#pragma once

#include <cstdint>

#include "kernels/projection/dome_fisheye.h"
#include "kernels/projection/equirectangular.h"
#include "kernels/projection/pinhole.h"

namespace ergodome {

//! The ways to put the sky on an image.
enum class ProjectionKind : std::int32_t { dome_fisheye, equirectangular, pinhole };

//! A projection with its image size.
template <class S>
struct ProjectionOf {
  ProjectionKind kind;
  int width_px;
  int height_px;
  DomeFisheye<S> dome;
  Pinhole<S> pinhole;
};

using Projection = ProjectionOf<double>;

inline namespace ERGO_TARGET {

//! A domemaster of the given full field of view, its top leaning to the front by `tilt` [rad].
ERGO_HD Projection make_dome_projection(int size_px, double field_of_view, double tilt) {
  return {ProjectionKind::dome_fisheye, size_px, size_px, {0.5 * field_of_view, ::sin(tilt), ::cos(tilt)}, {1.0, 1.0}};
}

ERGO_HD Projection make_equirectangular_projection(int width_px, int height_px) {
  return {ProjectionKind::equirectangular, width_px, height_px, {1.0, 0.0, 1.0}, {1.0, 1.0}};
}

//! A flat screen of the given horizontal field of view [rad], below π, with square pixels.
ERGO_HD Projection make_pinhole_projection(int width_px, int height_px, double field_of_view) {
  const double half_width = ::tan(0.5 * field_of_view);
  return {
      ProjectionKind::pinhole, width_px, height_px, {1.0, 0.0, 1.0}, {half_width, half_width * height_px / width_px}};
}

//! The same projection for kernels that work in another precision.
template <class S>
ERGO_HD ProjectionOf<S> converted_projection(const Projection& p) {
  return {p.kind,
          p.width_px,
          p.height_px,
          {static_cast<S>(p.dome.half_angle), static_cast<S>(p.dome.tilt_sine), static_cast<S>(p.dome.tilt_cosine)},
          {static_cast<S>(p.pinhole.half_width), static_cast<S>(p.pinhole.half_height)}};
}

//! View direction (x right, y up, z back; unit length) at a pixel position: (0.5, 0.5) is the middle of the top left pixel.
//!
//! With dual numbers that carry d/dx_px and d/dy_px (y downwards), the result carries the exact derivatives per pixel.
template <class T>
ERGO_HD Vector3<T> direction_from_pixel(const ProjectionOf<ScalarOf<T>>& projection, const T& x_px, const T& y_px) {
  using S = ScalarOf<T>;
  const T x = x_px * (S(2) / static_cast<S>(projection.width_px)) - S(1);
  const T y = S(1) - y_px * (S(2) / static_cast<S>(projection.height_px));
  switch (projection.kind) {
    case ProjectionKind::dome_fisheye:
      return direction_from_fisheye(projection.dome, x, y);
    case ProjectionKind::equirectangular:
      return direction_from_equirectangular(x, y);
    case ProjectionKind::pinhole:
      break;
  }
  return direction_from_pinhole(projection.pinhole, x, y);
}

//! Pixel position of a view direction: the inverse. False where the projection has none: beside and behind a flat screen.
ERGO_HD bool pixel_from_direction(const Projection& projection, const Vector3<double>& view, double& x_px,
                                  double& y_px) {
  double x = 0.0;
  double y = 0.0;
  switch (projection.kind) {
    case ProjectionKind::dome_fisheye:
      fisheye_from_direction(projection.dome, view, x, y);
      break;
    case ProjectionKind::equirectangular:
      equirectangular_from_direction(view, x, y);
      break;
    case ProjectionKind::pinhole:
      if (!pinhole_from_direction(projection.pinhole, view, x, y)) {
        return false;
      }
  }
  x_px = 0.5 * (x + 1.0) * projection.width_px;
  y_px = 0.5 * (1.0 - y) * projection.height_px;
  return true;
}

//! Fraction of a pixel that the image covers: 1, but for a fisheye falling to 0 across the rim of its circle.
template <class T>
ERGO_HD T image_coverage(const ProjectionOf<ScalarOf<T>>& projection, const T& x_px, const T& y_px) {
  using S = ScalarOf<T>;
  if (projection.kind != ProjectionKind::dome_fisheye) {
    return T(S(1));
  }
  const S half_width = S(0.5) * static_cast<S>(projection.width_px);
  const T x = x_px - half_width;
  const T y = y_px - S(0.5) * static_cast<S>(projection.height_px);
  return minimum(maximum((half_width + S(0.5)) - sqrt(x * x + y * y), T(S(0))), T(S(1)));
}

//! The largest angle that one pixel spans [rad], roughly: the middle of the image has it in every projection here.
ERGO_HD double pixel_angle(const Projection& projection) {
  switch (projection.kind) {
    case ProjectionKind::dome_fisheye:
      return 2.0 * projection.dome.half_angle / projection.width_px;
    case ProjectionKind::equirectangular:
      return 6.28318530717958647692 / projection.width_px;
    case ProjectionKind::pinhole:
      break;
  }
  return 2.0 * projection.pinhole.half_width / projection.width_px;
}

}  // namespace ERGO_TARGET
}  // namespace ergodome
