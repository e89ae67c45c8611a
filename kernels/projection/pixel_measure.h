#pragma once

#include "kernels/core/dual.h"
#include "kernels/core/lanes.h"
#include "kernels/projection/projection.h"

// Sizes of pixels and of images.
namespace ergodome::inline ERGO_TARGET {

//! Computes the image coordinates [px] of the centers of the pixels first, first + 1, ... of a
//! block of `count`: whole rows of `width_px` pixels, starting at row `first_row` of the image.
//! Lanes past the end repeat the last pixel.
template <class T>
ERGO_HD void pixel_middles(int width_px, int first_row, int count, int first, T& x_px, T& y_px) {
  using S = ScalarOf<T>;
  constexpr int lanes = RealTraits<T>::lane_count;
  const int begin = first < count ? first : count - 1;
  int row = begin / width_px;
  int column = begin - row * width_px;
  // The fast case, lanes within one row: registers that are filled lane by lane take longer than
  // most work on a pixel.
  if (first + lanes <= count && column + lanes <= width_px) {
    x_px = lane_numbers<T>() + T(static_cast<S>(column) + S(0.5));
    y_px = T(static_cast<S>(row + first_row) + S(0.5));
    return;
  }
  for (int i = 0; i < lanes; ++i) {
    set_lane(x_px, i, static_cast<S>(column) + S(0.5));
    set_lane(y_px, i, static_cast<S>(row + first_row) + S(0.5));
    if (first + i + 1 < count) {
      ++column;
      row += column == width_px ? 1 : 0;
      column = column == width_px ? 0 : column;
    }
  }
}

//! Change of the view direction per pixel, to the right and downwards.
template <class T>
struct PixelSteps {
  Vector3<T> across;
  Vector3<T> down;
};

template <class T>
ERGO_HD PixelSteps<T> pixel_steps(const ProjectionOf<ScalarOf<T>>& projection, const T& x_px, const T& y_px) {
  using D = Dual<T>;
  using S = ScalarOf<T>;
  const T one(S(1));
  const T zero(S(0));
  const Vector3<D> view = direction_from_pixel(projection, D(x_px, one, zero), D(y_px, zero, one));
  return {{view.x.along_x, view.y.along_x, view.z.along_x}, {view.x.along_y, view.y.along_y, view.z.along_y}};
}

//! Returns the solid angle of a pixel as seen from the camera [sr]: the area of the two steps to
//! its neighbors.
template <class T>
ERGO_HD T pixel_solid_angle(const ProjectionOf<ScalarOf<T>>& projection, const T& x_px, const T& y_px) {
  const PixelSteps<T> steps = pixel_steps(projection, x_px, y_px);
  const Vector3<T> area = cross(steps.across, steps.down);
  return safe_sqrt(dot(area, area));
}

//! Returns the longer side of a pixel [rad].
ERGO_HD double pixel_side(const Projection& projection, double x_px, double y_px) {
  const PixelSteps<double> steps = pixel_steps(projection, x_px, y_px);
  return ::sqrt(maximum(dot(steps.across, steps.across), dot(steps.down, steps.down)));
}

//! Returns the angle that a reference pixel spans [rad], which is the unit in which errors are
//! counted. The reference pixel is on the axis of a lens, on the horizon of a map, at the center of
//! a face or a screen. For most projections no pixel spans a larger angle.
ERGO_HD double pixel_angle(const Projection& projection) {
  const double width_px = projection.width_px;
  const FisheyeLens<double>& lens = projection.dome.lens;
  switch (projection.kind) {
    case ProjectionKind::dome_fisheye:
      if (projection.dome.off_centre == 0 && lens.law == LensLaw::equidistant) {
        return 2.0 * lens.half_angle / width_px;
      }
      return pixel_side(projection, 0.5 * width_px, 0.5 * projection.height_px);
    case ProjectionKind::equirectangular:
      return 2.0 * projection.equirectangular.half_azimuth / width_px;
    case ProjectionKind::cube:
      return 2.0 * cube_columns(projection.cube.layout) / width_px;
    case ProjectionKind::cylinder:
      return 2.0 * projection.cylinder.half_azimuth / width_px;
    case ProjectionKind::pinhole:
      break;
  }
  return 2.0 * projection.pinhole.half_width / width_px;
}

//! Returns the largest angle that a pixel of the image spans along a side [rad]. Lenses are sampled
//! along sixteen lines to the rim, where lenses that compress the rim have the maximum.
ERGO_HD double largest_pixel_angle(const Projection& projection) {
  constexpr int lines = 16;
  constexpr int positions = 32;
  double largest = pixel_angle(projection);
  if (projection.kind == ProjectionKind::cylinder) {
    return maximum(largest, 2.0 * projection.cylinder.half_height / projection.height_px);
  }
  if (projection.kind == ProjectionKind::equirectangular && !wraps_around(projection)) {
    return maximum(largest, 3.14159265358979323846 / projection.height_px);
  }
  if (projection.kind == ProjectionKind::pinhole) {
    return maximum(largest, 2.0 * projection.pinhole.half_height / projection.height_px);
  }
  const bool even = projection.dome.off_centre == 0 && projection.dome.lens.law == LensLaw::equidistant;
  if (projection.kind != ProjectionKind::dome_fisheye || even) {
    return largest;
  }
  const double middle = 0.5 * projection.width_px;
  // The centers of the outermost pixels are half a pixel inside the rim.
  const double rim = maximum(projection.dome.lens.rim * middle - 0.5, 0.0);
  for (int line = 0; line < lines; ++line) {
    const double turn = 6.28318530717958647692 * line / lines;
    for (int position = 0; position <= positions; ++position) {
      const double radius = rim * position / positions;
      largest = maximum(largest, pixel_side(projection, middle + radius * ::cos(turn), middle + radius * ::sin(turn)));
    }
  }
  return largest;
}

//! Returns the fraction of all directions that an image shows, 0 to 1, from a few thousand
//! directions spread evenly by the golden angle.
ERGO_HD double sky_share(const Projection& projection) {
  constexpr int directions = 4096;
  constexpr double golden_angle = 2.39996322972865332;
  int shown = 0;
  for (int i = 0; i < directions; ++i) {
    const double z = 1.0 - (2.0 * i + 1.0) / directions;
    const double across = ::sqrt(1.0 - z * z);
    const Vector3<double> view = {across * ::cos(golden_angle * i), across * ::sin(golden_angle * i), z};
    double x_px = 0.0;
    double y_px = 0.0;
    const bool there = pixel_from_direction(projection, view, x_px, y_px) && x_px >= 0.0 &&
                       x_px <= projection.width_px && y_px >= 0.0 && y_px <= projection.height_px;
    shown += there && image_coverage(projection, x_px, y_px) > 0.5 ? 1 : 0;
  }
  return static_cast<double>(shown) / directions;
}

}  // namespace ergodome::inline ERGO_TARGET
