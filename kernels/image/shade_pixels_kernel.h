#pragma once

#include "kernels/image/color_map.h"
#include "kernels/image/shade_pixels.h"
#include "kernels/sky/elliptic_filter.h"

namespace ergodome::inline ERGO_TARGET {

namespace detail {
ERGO_HD Vector3<float> vector_at(float* const (&from)[3], int index) {
  return {from[0][index], from[1][index], from[2][index]};
}

ERGO_HD void store_rgba(const ShadeBatch& batch, int index, const Vector3<float>& rgb, float alpha) {
  float* to = batch.rgba + 4 * static_cast<long>(index);
  to[0] = rgb.x;
  to[1] = rgb.y;
  to[2] = rgb.z;
  to[3] = alpha;
}
}  // namespace detail

//! Light of the sky behind the pixels; index i stands for the pixels i * lanes, i * lanes + 1, ... `Beaming` compiles the frequency
//! ratio in: a scene without it pays nothing.
//!
//! The map has no spectrum to shift, so the shift acts on its brightness alone: intensity over the cube of the frequency is the same
//! everywhere along a ray, and over all frequencies intensity goes with g⁴.
template <class T, bool Beaming>
struct ShadeSky {
  ShadeBatch batch;

  ERGO_HD void operator()(int index) const {
    constexpr int lanes = RealTraits<T>::lane_count;
    const int first = index * lanes;
    const T coverage = load_lanes<T>(batch.lens.coverage, first, batch.count);
    T scale = coverage * batch.exposure;
    if constexpr (Beaming) {
      const T g = load_lanes<T>(batch.lens.frequency_ratio, first, batch.count);
      const T g2 = g * g;
      // The ratio is not written where no light comes from.
      scale = select(coverage > T(0.0F), scale * (g2 * g2), T(0.0F));
    }
    const SkyLight<T> light =
        filter_sky(batch.sky, vectors(batch.lens.sky, first), vectors(batch.lens.sky_along_x, first),
                   vectors(batch.lens.sky_along_y, first), scale);
    for (int i = 0; i < lanes && first + i < batch.count; ++i) {
      float* to = batch.rgba + 4 * static_cast<long>(first + i);
      store_quad(to, light.pixel[i]);
      to[3] = lane(coverage, i);
    }
  }

 private:
  ERGO_HD Vector3<T> vectors(float* const (&from)[3], int first) const {
    return {load_lanes<T>(from[0], first, batch.count), load_lanes<T>(from[1], first, batch.count),
            load_lanes<T>(from[2], first, batch.count)};
  }
};

//! A heat map of one channel of the lens, dark where no light comes from.
struct ShadeHeatMap {
  ShadeBatch batch;

  //! The channel's value as the colour bar has it.
  ERGO_HD float value(int index) const {
    switch (batch.mode) {
      case ViewMode::steps:
        return batch.lens.steps[index];
      case ViewMode::error_estimate:
        return ::log10f(maximum(batch.lens.error_estimate[index], 1e-30F));
      case ViewMode::image_order:
        return batch.lens.half_orbits[index];
      case ViewMode::frequency_ratio:
        return ::log2f(maximum(batch.lens.frequency_ratio[index], 1e-30F));
      default:
        break;
    }
    const Vector3<float> area =
        cross(detail::vector_at(batch.lens.sky_along_x, index), detail::vector_at(batch.lens.sky_along_y, index));
    // log10 of the solid angle on the sky that one pixel sees; the bar is labelled relative to an undisturbed pixel.
    return -0.5F * ::log10f(maximum(dot(area, area), 1e-30F));
  }

  ERGO_HD void operator()(int index) const {
    const float coverage = batch.lens.coverage[index];
    const float place = (value(index) - batch.range_low) / (batch.range_high - batch.range_low);
    const Vector3<float> shown = batch.mode == ViewMode::frequency_ratio ? shift_color(place) : heat_color(place);
    // The renderer's output is linear; the colour map speaks in display values.
    const Vector3<float> linear = {srgb_decoded(shown.x), srgb_decoded(shown.y), srgb_decoded(shown.z)};
    detail::store_rgba(batch, index, coverage * linear, coverage);
  }
};

}  // namespace ergodome::inline ERGO_TARGET
