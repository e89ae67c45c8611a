#pragma once

#include "kernels/core/arithmetic.h"
#include "kernels/core/vector3.h"

// Light of disk, shells and objects in pixels, samples within pixels, and their composition with
// the picture.

namespace ergodome::inline ERGO_TARGET {

//! Light that disk, shells and objects add to pixels, and how much of the background the pixels
//! still see (`clear`).
template <class T>
struct SeenLanes {
  T red, green, blue;
  T clear;
};

template <class T>
ERGO_HD SeenLanes<T> nothing_seen() {
  using S = ScalarOf<T>;
  return {T(S(0)), T(S(0)), T(S(0)), T(S(1))};
}

//! Adds a surface behind all that lane `i` has seen so far. `light` is already multiplied by the
//! opacity.
template <class T>
ERGO_HD void put_behind(const Vector3<float>& light, float opacity, int i, SeenLanes<T>& seen) {
  const float clear = lane(seen.clear, i);
  set_lane(seen.red, i, lane(seen.red, i) + clear * light.x);
  set_lane(seen.green, i, lane(seen.green, i) + clear * light.y);
  set_lane(seen.blue, i, lane(seen.blue, i) + clear * light.z);
  set_lane(seen.clear, i, clear * (1.0F - opacity));
}

template <class T>
ERGO_HD SeenLanes<T> operator+(const SeenLanes<T>& a, const SeenLanes<T>& b) {
  return {a.red + b.red, a.green + b.green, a.blue + b.blue, a.clear + b.clear};
}

//! Number of samples along each side of a pixel that contains images finer than itself.
inline constexpr int near_samples = 4;

//! A part of a pixel: the offset of its middle from the pixel's middle, and its width [px].
template <class S>
struct NearSample {
  S along;
  S down;
  S width;
};

template <class S>
ERGO_HD NearSample<S> near_sample(int i) {
  constexpr S step = S(1) / near_samples;
  const int row = i / near_samples;
  return {(static_cast<S>(i - row * near_samples) + S(0.5)) * step - S(0.5),
          (static_cast<S>(row) + S(0.5)) * step - S(0.5), step};
}

//! Replaces what the lanes of a mask see by the mean of all samples. `sum`: sum over the samples.
template <class T>
ERGO_HD void take_mean(const MaskOf<T>& lanes, const SeenLanes<T>& sum, SeenLanes<T>& seen) {
  using S = ScalarOf<T>;
  constexpr S share = S(1) / (near_samples * near_samples);
  seen = {select(lanes, sum.red * share, seen.red), select(lanes, sum.green * share, seen.green),
          select(lanes, sum.blue * share, seen.blue), select(lanes, sum.clear * share, seen.clear)};
}

//! Composites what is seen over the pixels first, first + 1, ... of a block of `count`. `inside`:
//! fraction of each pixel that is inside the image; the light added to a pixel is multiplied by its
//! fraction.
template <class T>
ERGO_HD void lay_over(const SeenLanes<T>& seen, const T& inside, int first, int count, float* pixels) {
  for (int i = 0; i < RealTraits<T>::lane_count && first + i < count; ++i) {
    float* const rgba = pixels + 4 * static_cast<long>(first + i);
    const float clear = lane(seen.clear, i);
    const float part = lane(inside, i);
    if (clear < 1.0F) {
      rgba[0] = part * lane(seen.red, i) + clear * rgba[0];
      rgba[1] = part * lane(seen.green, i) + clear * rgba[1];
      rgba[2] = part * lane(seen.blue, i) + clear * rgba[2];
      rgba[3] = part * (1.0F - clear) + clear * rgba[3];
    }
  }
}

}  // namespace ergodome::inline ERGO_TARGET
