#pragma once

#include "kernels/core/dual.h"
#include "kernels/core/lanes.h"
#include "kernels/projection/projection.h"

namespace ergodome::inline ERGO_TARGET {

//! Image coordinates [px] of the middles of the pixels first, first + 1, ... of a block of `count`: whole rows of `width_px` pixels, the
//! first of which is row `first_row` of the image.
template <class T>
ERGO_HD void pixel_middles(int width_px, int first_row, int count, int first, T& x_px, T& y_px) {
  using S = ScalarOf<T>;
  for (int i = 0; i < RealTraits<T>::lane_count; ++i) {
    const int pixel = first + i < count ? first + i : count - 1;
    const int row = pixel / width_px;
    set_lane(x_px, i, static_cast<S>(pixel - row * width_px) + S(0.5));
    set_lane(y_px, i, static_cast<S>(row + first_row) + S(0.5));
  }
}

//! Solid angle that a pixel spans before the camera [sr]: the area of the two steps to its neighbours.
template <class T>
ERGO_HD T pixel_solid_angle(const ProjectionOf<ScalarOf<T>>& projection, const T& x_px, const T& y_px) {
  using D = Dual<T>;
  using S = ScalarOf<T>;
  const T one(S(1));
  const T zero(S(0));
  const Vector3<D> view = direction_from_pixel(projection, D(x_px, one, zero), D(y_px, zero, one));
  const Vector3<T> area = cross(Vector3<T>{view.x.along_x, view.y.along_x, view.z.along_x},
                                Vector3<T>{view.x.along_y, view.y.along_y, view.z.along_y});
  return safe_sqrt(dot(area, area));
}

}  // namespace ergodome::inline ERGO_TARGET
