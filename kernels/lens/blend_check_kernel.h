#pragma once

#include "kernels/core/lanes.h"
#include "kernels/lens/blend_check.h"
#include "kernels/lens/grid_build_kernel.h"

namespace ergodome::inline ERGO_TARGET {

//! Compares a lens with traced rays. Index i covers the points i * lanes, i * lanes + 1, ... See
//! CheckCells for the definition of the error.
template <class T>
struct CheckBlend {
  using S = ScalarOf<T>;
  using D = Dual<T>;
  BlendCheckBatch batch;

  ERGO_HD void operator()(int index) const {
    const int first = index * RealTraits<T>::lane_count;
    const T zero(S(0));
    const T one(S(1));
    const T gamma_turns = load_lanes<T>(batch.gamma_turns, first, batch.count);
    const T s = load_lanes<T>(batch.s, first, batch.count);
    const ChartStretch<T> stretch = chart_stretch(batch.camera.chart, gamma_turns, s);
    const Vector3<MixedDual<T>> n = chart_direction_at(batch.camera.chart, gamma_turns, stretch.alpha);
    const Vector3<T> direction = {n.x.value, n.y.value, n.z.value};
    MaskOf<T> reached;
    const Vector3<T> sky = detail::grid_sky(batch.camera, direction, reached);
    const GridSky<T> read =
        read_blended(batch.lens, ChartPosition<D>{{gamma_turns, one, zero}, {s, zero, one}, D(zero)}, one > zero);
    const Vector3<D>& v = read.sky;
    T sine;
    T cosine;
    sine_cosine(stretch.alpha.value, sine, cosine);
    const T scale = observed_scale(batch.observer, direction) * (S(1) / batch.pixel);
    const T error =
        scale * detail::screen_displacement(Vector3<T>{v.x.along_x, v.y.along_x, v.z.along_x},
                                            Vector3<T>{v.x.along_y, v.y.along_y, v.z.along_y}, stretch.alpha, sine,
                                            Vector3<T>{v.x.value - sky.x, v.y.value - sky.y, v.z.value - sky.z})
                    .length;
    const T shown = select(reached & (error < T(S(1e30))), error, T(S(1e30)));
    store_lanes(batch.error_px, first, batch.count, select(read.flagged, zero, shown));
    store_lanes(batch.area_px, first, batch.count,
                S(6.28318530717958647692) * absolute(sine) * absolute(stretch.alpha.along_y) * scale * scale);
  }
};

template <class T, class Action>
void dispatch(const BlendCheckBatch& batch, const Action& action) {
  action(CheckBlend<T>{batch});
}

}  // namespace ergodome::inline ERGO_TARGET
