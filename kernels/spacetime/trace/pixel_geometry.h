#pragma once

#include <type_traits>

#include "kernels/core/dual.h"
#include "kernels/core/lanes.h"
#include "kernels/projection/pixel_measure.h"
#include "kernels/spacetime/shadow/pixel_coverage.h"
#include "kernels/spacetime/trace/trace_pixels.h"

// Functions shared by all kernels that fill LensPixels, whether light is traced or read from a
// grid.
namespace ergodome::inline ERGO_TARGET {

//! Returns the number of pixels in a block.
ERGO_HD int pixel_count(const PixelBatch& batch) { return batch.row_count * batch.projection.width_px; }

//! Computes image coordinates of the centers of the pixels first, first + 1, ... of a block [px].
template <class T>
ERGO_HD void pixel_middles(const PixelBatch& batch, int first, T& x_px, T& y_px) {
  pixel_middles(batch.projection.width_px, batch.first_row, pixel_count(batch), first, x_px, y_px);
}

//! Returns the direction of an image position in the axes of the view, with its derivatives per
//! pixel.
template <class T>
ERGO_HD Vector3<Dual<T>> view_direction(const PixelBatch& batch, const T& x_px, const T& y_px) {
  using D = Dual<T>;
  using S = ScalarOf<T>;
  const T one(S(1));
  const T zero(S(0));
  return direction_from_pixel(batch.projection, D(x_px, one, zero), D(y_px, zero, one));
}

//! Rotates a direction from the view's axes to the observer's frame.
template <class D>
ERGO_HD Vector3<D> turned_from_view(const PixelBatch& batch, const Vector3<D>& view) {
  const auto row = [&](int i) {
    const float* m = batch.frame_from_view[i];
    return view.x * m[0] + view.y * m[1] + view.z * m[2];
  };
  return {row(0), row(1), row(2)};
}

//! Returns the direction of an image position in the observer's frame, with its derivatives per
//! pixel.
template <class T>
ERGO_HD Vector3<Dual<T>> observed_direction(const PixelBatch& batch, const T& x_px, const T& y_px) {
  return turned_from_view(batch, view_direction(batch, x_px, y_px));
}

//! One register of pixels with their viewing directions, the same for all eyes and observers.
template <class T>
struct ViewedPixels {
  int first;  //!< first pixel in the block
  T x_px;
  T y_px;
  T inside;  //!< fraction of each pixel that the image covers
  Vector3<Dual<T>> view;

  ERGO_HD ViewedPixels(const PixelBatch& batch, int index) : first(index * RealTraits<T>::lane_count) {
    pixel_middles(batch, first, x_px, y_px);
    view_them(batch);
  }

  //! Views pixels at any image positions. Their results are elements first_element, first_element +
  //! 1, ... of the channels.
  ERGO_HD ViewedPixels(const PixelBatch& batch, int first_element, const T& x, const T& y)
      : first(first_element), x_px(x), y_px(y) {
    view_them(batch);
  }

 private:
  ERGO_HD void view_them(const PixelBatch& batch) {
    inside = image_coverage(batch.projection, x_px, y_px);
    view = view_direction(batch, x_px, y_px);
  }
};

//! Computes the coverage of the lanes in `near_edge`, and moves their positions into the lit part
//! of the pixel. `n` is the direction in the frame of the edge. Returns whether any position moved.
template <class T>
ERGO_HD bool cover_lanes(const EdgeCurve& edge, const Vector3<Dual<T>>& n, const MaskOf<T>& near_edge, T& x_px, T& y_px,
                         T& lit) {
  using D = Dual<T>;
  const auto lane_of = [&](int i, T D::*part) {
    return Vector3<float>{lane(n.x.*part, i), lane(n.y.*part, i), lane(n.z.*part, i)};
  };
  bool shifted = false;
  if (any(near_edge)) {
    for (int i = 0; i < RealTraits<T>::lane_count; ++i) {
      if (mask_lane(near_edge, i)) {
        const PixelCoverage cover =
            cover_pixel(edge, lane_of(i, &D::value), lane_of(i, &D::along_x), lane_of(i, &D::along_y));
        set_lane(lit, i, cover.lit);
        set_lane(x_px, i, lane(x_px, i) + cover.shift_x);
        set_lane(y_px, i, lane(y_px, i) + cover.shift_y);
        shifted = shifted || cover.shift_x != 0.0F || cover.shift_y != 0.0F;
      }
    }
  }
  return shifted;
}

//! Returns a vector with its derivatives (R a Dual) or without (R its real number).
template <class R, class T>
ERGO_HD Vector3<R> part_of(const Vector3<Dual<T>>& v) {
  if constexpr (std::is_same_v<R, T>) {
    return {v.x.value, v.y.value, v.z.value};
  } else {
    return v;
  }
}

//! Writes the sky channels of pixels, rotated to the camera's azimuth. Where `valid` is false,
//! writes an arbitrary direction with a footprint as wide as the sky, or a zero direction if the
//! batch has no footprints. Writes no footprints if R has no derivatives.
template <class R>
ERGO_HD void store_sky(const PixelBatch& batch, int first, const Vector3<R>& sky, const MaskOf<RealOf<R>>& valid) {
  using T = RealOf<R>;
  using S = ScalarOf<T>;
  const int count = pixel_count(batch);
  const auto store = [&](const Vector3<T>& v, S otherwise, float* const(&to)[3]) {
    const Vector3<T> turned = turned_to_camera(batch.camera, v);
    const T other(otherwise);
    store_lanes(to[0], first, count, select(valid, turned.x, other));
    store_lanes(to[1], first, count, select(valid, turned.y, other));
    store_lanes(to[2], first, count, select(valid, turned.z, other));
  };
  const S elsewhere = has_footprints(batch.out) ? S(0.57735027) : S(0);
  store({value_of(sky.x), value_of(sky.y), value_of(sky.z)}, elsewhere, batch.out.sky);
  if constexpr (!std::is_same_v<R, T>) {
    constexpr S wide = S(1e3);
    store({sky.x.along_x, sky.y.along_x, sky.z.along_x}, wide, batch.out.sky_along_x);
    store({sky.x.along_y, sky.y.along_y, sky.z.along_y}, wide, batch.out.sky_along_y);
  }
}

}  // namespace ergodome::inline ERGO_TARGET
