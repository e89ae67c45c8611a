#pragma once

#include "kernels/core/lanes.h"
#include "kernels/geodesic/taylor.h"
#include "kernels/trace/trace_rays.h"
#if __has_include("kernels/geodesic/runge_kutta.h")
#include "kernels/geodesic/runge_kutta.h"
#endif

namespace ergodome::inline ERGO_TARGET {

//! Taylor series whose order suits the tolerance: about -ln(tolerance) / 2 is cheapest (Jorba & Zou 2005), and few orders do.
struct TraceByTaylor {
  template <class T>
  ERGO_HD RayEnd<T> operator()(ScalarOf<T> spin, const RayStart<T>& start, const MaskOf<RealOf<T>>& active,
                               const IntegrationSettings& settings, RealOf<T>& steps, MaskOf<RealOf<T>>& reached) const {
    if constexpr (sizeof(ScalarOf<T>) == 4) {
      return trace_taylor<10>(spin, start, active, settings, steps, reached);
    } else {
      return settings.tolerance < 1e-9 ? trace_taylor<20>(spin, start, active, settings, steps, reached)
                                       : trace_taylor<10>(spin, start, active, settings, steps, reached);
    }
  }
};

//! Traces the rays of a batch; index i stands for the rays i * lanes, i * lanes + 1, ...
template <class Tracer, class T>
struct TraceRays {
  RayBatch<ScalarOf<T>> batch;

  ERGO_HD void operator()(int index) const {
    using S = ScalarOf<T>;
    const int first = index * RealTraits<T>::lane_count;
    const int count = batch.count;
    const Vector3<T> n = {load_lanes<T>(batch.direction[0], first, count), load_lanes<T>(batch.direction[1], first, count),
                          load_lanes<T>(batch.direction[2], first, count)};
    const S spin = batch.camera.spin;
    const RayStart<T> start = start_ray(batch.camera, n);
    const auto bright = comes_from_sky(spin, batch.camera.horizon_r, start);
    T steps(S(0));
    MaskOf<T> reached = bright;
    const RayEnd<T> end = Tracer{}(spin, start, bright, batch.settings, steps, reached);
    const T zero(S(0));
    const Vector3<T> sky = turned_to_camera(batch.camera, end.sky);
    store_lanes(batch.sky[0], first, count, select(reached, sky.x, zero));
    store_lanes(batch.sky[1], first, count, select(reached, sky.y, zero));
    store_lanes(batch.sky[2], first, count, select(reached, sky.z, zero));
    store_lanes(batch.frequency_ratio, first, count, S(1) / start.energy);
    const T escaped(S(static_cast<int>(RayStatus::escaped)));
    const T captured(S(static_cast<int>(RayStatus::captured)));
    const T not_converged(S(static_cast<int>(RayStatus::not_converged)));
    store_lanes(batch.status, first, count, select(bright, select(reached, escaped, not_converged), captured));
    store_lanes(batch.steps, first, count, steps);
    store_lanes(batch.error_estimate, first, count, select(reached, end.error_estimate, zero));
    store_lanes(batch.mino_time, first, count, select(reached, end.mino_time, zero));
  }
};

//! Calls action(tracer) with the tracer of a method.
template <class Action>
inline void dispatch_method(TraceMethod method, const Action& action) {
  switch (method) {
    case TraceMethod::taylor:
    default:
      action(TraceByTaylor{});
      break;
  }
}

}  // namespace ergodome::inline ERGO_TARGET
