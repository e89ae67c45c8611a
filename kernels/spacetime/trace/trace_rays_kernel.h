#pragma once

#include "kernels/core/lanes.h"
#include "kernels/spacetime/geodesic/baseline_rk34.h"
#include "kernels/spacetime/geodesic/closed_form.h"
#include "kernels/spacetime/geodesic/runge_kutta.h"
#include "kernels/spacetime/geodesic/taylor.h"
#include "kernels/spacetime/trace/omni_camera.h"

// Traces batches of single rays by any method.
namespace ergodome::inline ERGO_TARGET {

//! Taylor series of order 10, or 20 in double for tolerances below 1e-9. The cheapest order is
//! about -ln(tolerance) / 2 (Jorba & Zou 2005).
struct TraceByTaylor {
  template <class T>
  ERGO_HD RayEnd<T> operator()(ScalarOf<T> spin, const RayStart<T>& start, const MaskOf<RealOf<T>>& active,
                               const IntegrationSettings& settings, RealOf<T>& steps,
                               MaskOf<RealOf<T>>& reached) const {
    if constexpr (sizeof(ScalarOf<T>) == 4) {
      return trace_taylor<10>(spin, start, active, settings, steps, reached);
    } else {
      return settings.tolerance < 1e-9 ? trace_taylor<20>(spin, start, active, settings, steps, reached)
                                       : trace_taylor<10>(spin, start, active, settings, steps, reached);
    }
  }
};

template <class Tableau>
struct TraceByRungeKutta {
  template <class T>
  ERGO_HD RayEnd<T> operator()(ScalarOf<T> spin, const RayStart<T>& start, const MaskOf<T>& active,
                               const IntegrationSettings& settings, T& steps, MaskOf<T>& reached) const {
    return trace_runge_kutta<Tableau>(spin, start, active, settings, steps, reached);
  }
};

struct TraceByBaseline {
  template <class T>
  ERGO_HD RayEnd<T> operator()(ScalarOf<T> spin, const RayStart<T>& start, const MaskOf<T>& active,
                               const IntegrationSettings& settings, T& steps, MaskOf<T>& reached) const {
    return trace_baseline_rk34(spin, start, active, settings, steps, reached);
  }
};

//! Closed form. Elliptic functions branch differently for each ray, so lanes are computed one by
//! one, in double.
struct TraceByClosedForm {
  template <class T>
  ERGO_HD RayEnd<T> operator()(ScalarOf<T> spin, const RayStart<T>& start, const MaskOf<T>& active,
                               const IntegrationSettings&, T& steps, MaskOf<T>& reached) const {
    using S = ScalarOf<T>;
    const T zero(S(0));
    RayEnd<T> end = {{zero, zero, zero}, zero, zero};
    for (int i = 0; i < RealTraits<T>::lane_count; ++i) {
      if (!mask_lane(active, i)) {
        continue;
      }
      const auto at = [&](const T& value) { return static_cast<double>(lane(value, i)); };
      const RayStart<double> ray = {at(start.axial_angular_momentum),
                                    at(start.polar_constant),
                                    at(start.shear_constant),
                                    at(start.u),
                                    at(start.u_rate),
                                    {at(start.m.x), at(start.m.y), at(start.m.z)},
                                    {at(start.m_rate.x), at(start.m_rate.y), at(start.m_rate.z)},
                                    at(start.energy),
                                    start.ingoing,
                                    static_cast<double>(start.turn)};
      const RayEnd<double> exact = trace_closed_form(static_cast<double>(spin), ray);
      set_lane(end.sky.x, i, static_cast<S>(exact.sky.x));
      set_lane(end.sky.y, i, static_cast<S>(exact.sky.y));
      set_lane(end.sky.z, i, static_cast<S>(exact.sky.z));
      set_lane(end.mino_time, i, static_cast<S>(exact.mino_time));
      set_lane(end.error_estimate, i, static_cast<S>(exact.error_estimate));
    }
    steps = select(active, T(S(1)), zero);
    reached = active & (dot(end.sky, end.sky) < T(S(2)));
    return end;
  }
};

//! Traces the rays of a batch. `camera` is the batch's camera, or that of an omnidirectional eye,
//! which differs for each direction.
template <class Tracer, class T, class Camera>
ERGO_HD void trace_rays_at(const RayBatch<ScalarOf<T>>& batch, const Camera& camera, int first) {
  using S = ScalarOf<T>;
  const int count = batch.count;
  const Vector3<T> n = {load_lanes<T>(batch.direction[0], first, count),
                        load_lanes<T>(batch.direction[1], first, count),
                        load_lanes<T>(batch.direction[2], first, count)};
  const RayStart<T> start = start_ray(camera, n);
  const auto bright = comes_from_sky(camera.spin, camera.horizon_r, start);
  T steps(S(0));
  MaskOf<T> reached = bright;
  const RayEnd<T> end = Tracer{}(camera.spin, start, bright, batch.settings, steps, reached);
  const T zero(S(0));
  const Vector3<T> sky = turned_to_camera(batch.camera, end.sky);
  store_lanes(batch.sky[0], first, count, select(reached, sky.x, zero));
  store_lanes(batch.sky[1], first, count, select(reached, sky.y, zero));
  store_lanes(batch.sky[2], first, count, select(reached, sky.z, zero));
  store_lanes(batch.frequency_ratio, first, count, S(1) / start.energy);
  const T escaped(S(static_cast<int>(LightEnd::sky)));
  const T captured(S(static_cast<int>(LightEnd::horizon)));
  const T not_converged(S(static_cast<int>(LightEnd::unresolved)));
  store_lanes(batch.status, first, count, select(bright, select(reached, escaped, not_converged), captured));
  store_lanes(batch.steps, first, count, steps);
  store_lanes(batch.error_estimate, first, count, select(reached, end.error_estimate, zero));
  store_lanes(batch.mino_time, first, count, select(reached, end.mino_time, zero));
}

//! Traces the rays of one camera. Index i covers the rays i * lanes, i * lanes + 1, ...
template <class Tracer, class T>
struct TraceRays {
  RayBatch<ScalarOf<T>> batch;

  ERGO_HD void operator()(int index) const {
    trace_rays_at<Tracer, T>(batch, batch.camera, index * RealTraits<T>::lane_count);
  }
};

//! Traces the rays of an omnidirectional eye, whose position depends on the direction.
template <class T>
struct TraceOmniRays {
  OmniRayBatch batch;

  ERGO_HD void operator()(int index) const {
    trace_rays_at<TraceByTaylor, T>(batch.rays, batch.camera, index * RealTraits<T>::lane_count);
  }
};

//! Calls action(tracer) with the tracer of a method.
template <class Action>
inline void dispatch_method(TraceMethod method, const Action& action) {
  switch (method) {
    case TraceMethod::taylor:
      action(TraceByTaylor{});
      break;
    case TraceMethod::rk34:
      action(TraceByRungeKutta<RungeKutta34>{});
      break;
    case TraceMethod::cash_karp:
      action(TraceByRungeKutta<CashKarp>{});
      break;
    case TraceMethod::baseline_rk34:
      action(TraceByBaseline{});
      break;
    case TraceMethod::closed_form:
      action(TraceByClosedForm{});
      break;
  }
}

template <class T, class Action>
void dispatch(const RayBatch<ScalarOf<T>>& batch, const Action& action) {
  dispatch_method(batch.method, [&](auto tracer) { action(TraceRays<decltype(tracer), T>{batch}); });
}

template <class T, class Action>
void dispatch(const OmniRayBatch& batch, const Action& action) {
  action(TraceOmniRays<T>{batch});
}

}  // namespace ergodome::inline ERGO_TARGET
