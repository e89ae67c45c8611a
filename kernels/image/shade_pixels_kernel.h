#pragma once

#include "kernels/image/color_map.h"
#include "kernels/image/shade_pixels.h"
#include "kernels/projection/pixel_measure.h"
#include "kernels/sky/blackbody.h"
#include "kernels/sky/elliptic_filter.h"

// Shades pixels: from lens channels to light or a heat map.
namespace ergodome::inline ERGO_TARGET {

//! Maximum factor of brightening. At caustics a pixel's footprint on the sky has no area, which
//! would make the factor infinite.
inline constexpr float brightening_limit = 1000.0F;

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

//! Computes the light of the sky behind the pixels. Index i covers the pixels i * lanes, i * lanes
//! + 1, ... Each combination of options is compiled separately, so that a scene pays only for those
//! it uses.
//!
//! A map has no spectrum to shift. SkyShift::luminance changes only its brightness: intensity over
//! the cube of the frequency is constant along a ray, so over all frequencies intensity scales with
//! g⁴. For SkyShift::blackbody_fit see shifted_light().
template <class T, SkyFilter Filter, SkyShift Shift, bool Brightened>
struct ShadeSky {
  ShadeBatch batch;

  ERGO_HD void operator()(int index) const {
    const int first = index * RealTraits<T>::lane_count;
    shade(batch.lens, first, batch.count, batch.rgba + 4 * static_cast<long>(first), batch.count - first);
  }

  //! Shades the pixels first, first + 1, ... of `lens`, which has `count`. Writes at most `wanted` of
  //! them, beginning at `to`.
  ERGO_HD void shade(const LensPixels& lens, int first, int count, float* to, int wanted) const {
    constexpr int lanes = RealTraits<T>::lane_count;
    const Pixels at = {lens, first, count};
    const T coverage = load_lanes<T>(lens.coverage, first, count);
    T scale = coverage * batch.exposure;
    T g(1.0F);
    if constexpr (Shift != SkyShift::none) {
      g = load_lanes<T>(lens.frequency_ratio, first, count);
    }
    if constexpr (Shift == SkyShift::luminance) {
      const T g2 = g * g;
      // The frequency ratio is undefined where no light arrives, so the light is set to 0 there.
      scale = select(coverage > T(0.0F), scale * (g2 * g2), T(0.0F));
    }
    if constexpr (Brightened) {
      scale = scale * magnification(at);
    }
    const SkyLight<T> light = seen_at(at, scale, to, wanted);
    for (int i = 0; i < lanes && i < wanted; ++i) {
      if constexpr (Shift == SkyShift::blackbody_fit) {
        store_shifted(light.pixel[i], lane(g, i), to + 4 * i);
      } else {
        store_quad(to + 4 * i, light.pixel[i]);
      }
      to[4 * i + 3] = batch.opacity ? 0.0F : lane(coverage, i);
    }
  }

 private:
  //! A register of pixels.
  struct Pixels {
    const LensPixels& lens;
    int first;
    int count;
  };

  static ERGO_HD Vector3<T> vectors(float* const (&from)[3], const Pixels& at) {
    return {load_lanes<T>(from[0], at.first, at.count), load_lanes<T>(from[1], at.first, at.count),
            load_lanes<T>(from[2], at.first, at.count)};
  }

  //! Returns the map's light over the pixels, times a factor. For SkyFilter::polygon, `filtered` is
  //! the light of the first of `wanted` pixels.
  ERGO_HD SkyLight<T> seen_at(const Pixels& at, const T& factor, const float* filtered, int wanted) const {
    if constexpr (Filter == SkyFilter::ewa) {
      return filter_sky(batch.sky, vectors(at.lens.sky, at), vectors(at.lens.sky_along_x, at),
                        vectors(at.lens.sky_along_y, at), factor);
    } else if constexpr (Filter == SkyFilter::point) {
      return sample_sky(batch.sky, vectors(at.lens.sky, at), factor);
    } else {
      SkyLight<T> light = detail::no_light<T>();
      for (int i = 0; i < RealTraits<T>::lane_count && i < wanted; ++i) {
        light.pixel[i] = lane(factor, i) * load_quad(filtered + 4 * i);
      }
      return light;
    }
  }

  //! Returns the solid angle of the pixels at the camera over that of their footprints on the sky.
  //! The ratio is limited at caustics.
  ERGO_HD T magnification(const Pixels& at) const {
    const Vector3<T> along_x = vectors(at.lens.sky_along_x, at);
    const Vector3<T> area = cross(along_x, vectors(at.lens.sky_along_y, at));
    const T whole_sky(12.566371F);
    // Recognizes pixels without light from the sky: store_sky() writes derivatives for them that
    // are too large to be real.
    const auto lost = dot(along_x, along_x) > T(1e6F);
    const T on_sky = select(lost, whole_sky, minimum(safe_sqrt(dot(area, area)), whole_sky));
    T x_px(0.0F);
    T y_px(0.0F);
    pixel_middles(batch.projection.width_px, batch.first_row, batch.count, at.first, x_px, y_px);
    const T on_screen = pixel_solid_angle(batch.projection, x_px, y_px);
    return on_screen / maximum(on_sky, on_screen * (1.0F / brightening_limit));
  }

  //! Writes light shifted by g. The fourth component of `light` is as in the texels of CubeMap.
  ERGO_HD void store_shifted(const Quad& light, float g, float* to) const {
    const Vector3<float> rgb = {quad_part(light, 0), quad_part(light, 1), quad_part(light, 2)};
    const float luminance = luminance_of(rgb);
    Vector3<float> seen = {0.0F, 0.0F, 0.0F};
    // Without light, g is undefined and the temperature would be 0 / 0, so the result stays black.
    if (luminance > 1e-37F) {
      // In very dark texels, rounding may put the temperature outside its range.
      const float lowest = lowest_log_temperature;
      const float highest = highest_log_temperature;
      const float log_temperature = log_reference_temperature + quad_part(light, 3) / luminance;
      seen = shifted_light(batch.colours, rgb, minimum(maximum(log_temperature, lowest), highest), g);
    }
    to[0] = seen.x;
    to[1] = seen.y;
    to[2] = seen.z;
  }
};

namespace detail {
template <class T, SkyFilter Filter, SkyShift Shift, class Action>
inline void dispatch_brightening(const ShadeBatch& batch, const Action& action) {
  if (batch.brightening) {
    action(ShadeSky<T, Filter, Shift, true>{batch});
  } else {
    action(ShadeSky<T, Filter, Shift, false>{batch});
  }
}

template <class T, SkyFilter Filter, class Action>
inline void dispatch_shift(const ShadeBatch& batch, const Action& action) {
  switch (batch.shift) {
    case SkyShift::none:
      return dispatch_brightening<T, Filter, SkyShift::none>(batch, action);
    case SkyShift::luminance:
      return dispatch_brightening<T, Filter, SkyShift::luminance>(batch, action);
    case SkyShift::blackbody_fit:
      return dispatch_brightening<T, Filter, SkyShift::blackbody_fit>(batch, action);
  }
}
}  // namespace detail

//! Calls action(functor) with the functor for the options of a batch.
template <class T, class Action>
inline void dispatch_shading(const ShadeBatch& batch, const Action& action) {
  switch (batch.filter) {
    case SkyFilter::ewa:
      return detail::dispatch_shift<T, SkyFilter::ewa>(batch, action);
    case SkyFilter::point:
      return detail::dispatch_shift<T, SkyFilter::point>(batch, action);
    case SkyFilter::polygon:
      return detail::dispatch_shift<T, SkyFilter::polygon>(batch, action);
  }
}

//! Draws a heat map of one channel of the lens, dark where no light arrives.
struct ShadeHeatMap {
  ShadeBatch batch;

  //! Returns the channel's value as on the color bar: log10 of error estimate and magnification,
  //! log2 of the frequency ratio, other channels as they are.
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
    float x_px = 0.0F;
    float y_px = 0.0F;
    pixel_middles(batch.projection.width_px, batch.first_row, batch.count, index, x_px, y_px);
    const float on_screen = pixel_solid_angle(batch.projection, x_px, y_px);
    return ::log10f(maximum(on_screen, 1e-30F)) - 0.5F * ::log10f(maximum(dot(area, area), 1e-30F));
  }

  ERGO_HD void operator()(int index) const {
    const float coverage = batch.lens.coverage[index];
    const float position = (value(index) - batch.range_low) / (batch.range_high - batch.range_low);
    const Vector3<float> shown = batch.mode == ViewMode::frequency_ratio ? shift_color(position) : heat_color(position);
    // The renderer's output is linear, so the display values of the color map are decoded.
    const Vector3<float> linear = {srgb_decoded(shown.x), srgb_decoded(shown.y), srgb_decoded(shown.z)};
    detail::store_rgba(batch, index, coverage * linear, coverage);
  }
};

//! Calls a functor that computes one element, for all elements of a register.
template <class T, class Functor>
struct EachLane {
  Functor functor;
  int count;  //!< total number of elements

  ERGO_HD void operator()(int index) const {
    constexpr int lanes = RealTraits<T>::lane_count;
    for (int i = index * lanes; i < (index + 1) * lanes && i < count; ++i) {
      functor(i);
    }
  }
};

template <class T, class Action>
void dispatch(const ShadeBatch& batch, const Action& action) {
  if (batch.mode == ViewMode::sky) {
    dispatch_shading<T>(batch, action);
  } else {
    action(EachLane<T, ShadeHeatMap>{{batch}, batch.count});
  }
}

}  // namespace ergodome::inline ERGO_TARGET
