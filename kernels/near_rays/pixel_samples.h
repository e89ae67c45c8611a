#pragma once

#include "kernels/near_rays/seen_light.h"

// Samples within pixels that see the disk, shells or objects, and their composition with the
// picture.
namespace ergodome::inline ERGO_TARGET {

//! Samples along each side of a pixel that contains images finer than itself.
inline constexpr int near_samples = 4;

//! A part of a pixel: the offset of its middle from the pixel's, and its width [px].
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

//! Composes what is seen with the pixels first, first + 1, ... of a block of `count`, weighted by
//! how much of each is `inside` the image.
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
