#pragma once

#include "kernels/spacetime/trace/omni_camera.h"
#include "kernels/spacetime/trace/trace_pixels_kernel.h"

namespace ergodome::inline ERGO_TARGET {

//! Traces the pixels of a batch in which every pixel has its own camera; otherwise like
//! TracePixels.
template <class T, bool Footprints>
struct TraceOmniPixels {
  using D = Dual<T>;
  using Ray = std::conditional_t<Footprints, D, T>;
  using S = ScalarOf<T>;

  OmniBatch batch;

  ERGO_HD void operator()(int index) const {
    const PixelBatch& pixels = batch.pixels;
    const int first = index * RealTraits<T>::lane_count;
    const T one(S(1));
    const T zero(S(0));
    T x_px;
    T y_px;
    pixel_middles(pixels, first, x_px, y_px);
    const T inside = image_coverage(pixels.projection, x_px, y_px);
    Vector3<D> view = observed_direction(pixels, x_px, y_px);
    T sky_lit = one;
    if (cover_lanes(pixels.edge, view, touches_edge(pixels, view), x_px, y_px, sky_lit)) {
      view = observed_direction(pixels, x_px, y_px);
    }
    const RayStart<Ray> start = start_omni_ray(batch.camera, part_of<Ray>(view));
    const auto bright = comes_from_sky(batch.camera.spin, batch.camera.horizon_r, plain_start(start));
    const auto dark = (!bright) & (sky_lit >= one);
    const T lit = select(dark, zero, sky_lit * inside);
    const auto wanted = bright & (lit > zero);
    T steps = zero;
    MaskOf<T> reached = wanted;
    const RayEnd<Ray> end =
        trace_taylor<picture_order>(batch.camera.spin, start, wanted, pixels.settings, steps, reached);
    store_traced<T>(pixels, first, start, end, steps, reached, lit, wanted);
  }
};

template <class T, class Action>
void dispatch(const OmniBatch& batch, const Action& action) {
  if (has_footprints(batch.pixels.out)) {
    action(TraceOmniPixels<T, true>{batch});
  } else {
    action(TraceOmniPixels<T, false>{batch});
  }
}

}  // namespace ergodome::inline ERGO_TARGET
