#pragma once

#include "kernels/core/lanes.h"
#include "kernels/stars/observed_positions_kernel.h"
#include "kernels/stars/search/patch_measure.h"

namespace ergodome::inline ERGO_TARGET {

//! Measures a patch by 5 x 5 samples. Runs once, with samples as lanes.
template <class T>
struct MeasurePatch {
  const PatchMeasureBatch& batch;

  ERGO_HD void operator()(int /*index*/) const {
    Sums sums{T(infinite), T(-infinite), T(0.0F), T(0.0F), T(0.0F), T(0.0F), T(0.0F)};
    // The pack with the middle comes first, since distances are measured from the middle.
    constexpr int middle_lot = middle_sample / lanes;
    const Vector3<T> beside = measure_lot(middle_lot, sums);
    const auto in_middle = [](const T& value) { return T(lane(value, middle_sample - lanes * middle_lot)); };
    const Vector3<T> middle = {in_middle(beside.x), in_middle(beside.y), in_middle(beside.z)};
    see_from(middle, beside, sums);
    for (int lot = 0; lanes * lot < samples; ++lot) {
      if (lot != middle_lot) {
        see_from(middle, measure_lot(lot, sums), sums);
      }
    }
    *batch.out = {-largest(-sums.lowest_sky),
                  largest(sums.highest_sky),
                  largest(sums.camera),
                  largest(sums.ratio),
                  largest(sums.brightening),
                  largest(sums.frequency_ratio),
                  {lane(middle.x, 0), lane(middle.y, 0), lane(middle.z, 0)},
                  sqrt(largest(sums.chord_square)),
                  is_regular<T>(*batch.patch)};
  }

 private:
  static constexpr int lanes = RealTraits<T>::lane_count;
  static constexpr int side = 5;
  static constexpr int samples = side * side;
  static constexpr int middle_sample = samples / 2;
  static constexpr float infinite = 3e38F;

  //! Minima and maxima over the samples so far.
  struct Sums {
    T lowest_sky, highest_sky;
    T camera;
    T ratio;
    T brightening;
    T frequency_ratio;
    T chord_square;
  };

  ERGO_HD static float largest(const T& value) {
    float max_value = lane(value, 0);
    for (int i = 1; i < lanes; ++i) {
      max_value = maximum(max_value, lane(value, i));
    }
    return max_value;
  }

  //! Evaluates one pack of samples. Returns their directions in the observer's frame.
  ERGO_HD Vector3<T> measure_lot(int lot, Sums& sums) const {
    T u;
    T v;
    for (int i = 0; i < lanes; ++i) {
      const int sample = lanes * lot + i < samples ? lanes * lot + i : samples - 1;
      const int row = sample / side;
      set_lane(u, i, static_cast<float>(sample - side * row) / (side - 1));
      set_lane(v, i, static_cast<float>(row) / (side - 1));
    }
    return measure(u, v, sums);
  }

  ERGO_HD static void see_from(const Vector3<T>& middle, const Vector3<T>& ways, Sums& sums) {
    const Vector3<T> apart = ways - middle;
    sums.chord_square = maximum(sums.chord_square, dot(apart, apart));
  }

  //! Evaluates samples at (u, v). Returns their directions in the observer's frame.
  ERGO_HD Vector3<T> measure(const T& u, const T& v, Sums& sums) const {
    const T gamma_turns = u * batch.width_turns + T(batch.gamma_turns);
    const ChartStretch<T> stretch = chart_stretch(batch.chart, gamma_turns, v * batch.height + T(batch.s));
    const Vector3<MixedDual<T>> way = chart_direction_at(batch.chart, gamma_turns, stretch.alpha);
    const Vector3<T> rain = {way.x.value, way.y.value, way.z.value};
    T sine;
    T cosine;
    sine_cosine(stretch.alpha.value, sine, cosine);
    const T camera = absolute(sine * stretch.alpha.along_y) * 6.2831853F;
    const T area =
        determinant(seen_from(*batch.patch, T(0.0F), T(0.0F), u, v)) * (1.0F / (batch.width_turns * batch.height));
    sums.lowest_sky = minimum(sums.lowest_sky, area);
    sums.highest_sky = maximum(sums.highest_sky, area);
    sums.camera = maximum(sums.camera, camera);
    sums.ratio = maximum(sums.ratio, camera / maximum(absolute(area), T(1e-30F)));
    return seen_at(rain, sums);
  }

  //! Updates the extremes by what the observer sees in rain-frame directions. Returns these
  //! directions in the observer's frame.
  ERGO_HD Vector3<T> seen_at(const Vector3<T>& rain, Sums& sums) const {
    const ObservedLight<T> light = observed_light(batch.observer, batch.energy, rain);
    sums.brightening = maximum(sums.brightening, light.brightening);
    sums.frequency_ratio = maximum(sums.frequency_ratio, light.frequency_ratio);
    return light.direction;
  }
};

template <class T, class Action>
void dispatch(const PatchMeasureBatch& batch, const Action& action) {
  action(MeasurePatch<T>{batch});
}

}  // namespace ergodome::inline ERGO_TARGET
