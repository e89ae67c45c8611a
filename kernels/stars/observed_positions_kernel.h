#pragma once

#include "kernels/core/lanes.h"
#include "kernels/stars/observed_positions.h"

// The kernel that computes what an observer sees at positions of a lens chart.
namespace ergodome::inline ERGO_TARGET {

//! Light from a rain-frame direction as an observer sees it.
template <class T>
struct ObservedLight {
  Vector3<T> direction;
  T brightening;  //!< the observer's solid angle over the rain frame's
  T frequency_ratio;
};

template <class T>
ERGO_HD ObservedLight<T> observed_light(const AberrationOf<ScalarOf<T>>& observer,
                                        const DirectionForm<ScalarOf<T>>& energy, const Vector3<T>& rain) {
  using S = ScalarOf<T>;
  const auto inverse = [](const FrameBoostOf<S>& b) { return FrameBoostOf<S>{b.axis, S(1) / b.stretch}; };
  T to_zamo;
  T to_observer;
  const Vector3<T> in_zamo = aberrated(inverse(observer.rain_from_zamo), rain, to_zamo);
  const Vector3<T> seen = aberrated(inverse(observer.zamo_from_observer), in_zamo, to_observer);
  const T scale = T(S(1)) / (to_zamo * to_observer);
  return {seen, scale * scale, T(S(1)) / maximum(detail::evaluate(energy, rain) * scale, T(S(1e-6)))};
}

//! Computes what an observer sees. Index i covers positions i * lanes to (i + 1) * lanes - 1.
template <class T>
struct ObservePositions {
  const ObservedPositionBatch& batch;

  ERGO_HD void operator()(int index) const {
    const int first = index * RealTraits<T>::lane_count;
    const T gamma_turns = load_lanes<T>(batch.gamma_turns, first, batch.count);
    const ChartStretch<T> stretch = chart_stretch(batch.chart, gamma_turns, load_lanes<T>(batch.s, first, batch.count));
    const Vector3<MixedDual<T>> way = chart_direction_at(batch.chart, gamma_turns, stretch.alpha);
    T sine;
    T cosine;
    sine_cosine(stretch.alpha.value, sine, cosine);
    const ObservedLight<T> light =
        observed_light(batch.observer, batch.energy, Vector3<T>{way.x.value, way.y.value, way.z.value});
    const auto store = [&](float* to, const T& value) { store_lanes(to, first, batch.count, value); };
    store(batch.direction[0], light.direction.x);
    store(batch.direction[1], light.direction.y);
    store(batch.direction[2], light.direction.z);
    store(batch.area, absolute(sine * stretch.alpha.along_y) * 6.2831853F * light.brightening);
    store(batch.frequency_ratio, light.frequency_ratio);
  }
};

template <class T, class Action>
void dispatch(const ObservedPositionBatch& batch, const Action& action) {
  action(ObservePositions<T>{batch});
}

}  // namespace ergodome::inline ERGO_TARGET
