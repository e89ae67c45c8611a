#pragma once

#include "kernels/near_rays/follow_to_radius.h"
#include "kernels/spacetime/trace/trace_pixels_kernel.h"

// Follows the rays of pixels by any integrator, to measure its steps and errors.
namespace ergodome::inline ERGO_TARGET {

//! Integrators in the form that FollowRays calls: to a radius, and to the sky.
struct FollowByTaylor {
  template <class T>
  ERGO_HD FollowedRay<T> to_radius(ScalarOf<T> spin, const RayStart<T>& start, const WayEnd<T>& end,
                                   const MaskOf<T>& wanted, const IntegrationSettings& settings) const {
    return follow_taylor<picture_order>(spin, start, end, wanted, settings);
  }
  template <class T>
  ERGO_HD RayEnd<T> to_sky(ScalarOf<T> spin, const RayStart<T>& start, const MaskOf<T>& wanted,
                           const IntegrationSettings& settings, T& steps, MaskOf<T>& reached) const {
    return trace_taylor<picture_order>(spin, start, wanted, settings, steps, reached);
  }
};

template <class Tableau>
struct FollowByRungeKutta {
  template <class T>
  ERGO_HD FollowedRay<T> to_radius(ScalarOf<T> spin, const RayStart<T>& start, const WayEnd<T>& end,
                                   const MaskOf<T>& wanted, const IntegrationSettings& settings) const {
    return follow_runge_kutta<Tableau>(spin, start, end, wanted, settings);
  }
  template <class T>
  ERGO_HD RayEnd<T> to_sky(ScalarOf<T> spin, const RayStart<T>& start, const MaskOf<T>& wanted,
                           const IntegrationSettings& settings, T& steps, MaskOf<T>& reached) const {
    return trace_runge_kutta<Tableau>(spin, start, wanted, settings, steps, reached);
  }
};

struct FollowByBaseline {
  template <class T>
  ERGO_HD FollowedRay<T> to_radius(ScalarOf<T> spin, const RayStart<T>& start, const WayEnd<T>& end,
                                   const MaskOf<T>& wanted, const IntegrationSettings& settings) const {
    return follow_baseline(spin, start, end, wanted, settings);
  }
  template <class T>
  ERGO_HD RayEnd<T> to_sky(ScalarOf<T> spin, const RayStart<T>& start, const MaskOf<T>& wanted,
                           const IntegrationSettings& settings, T& steps, MaskOf<T>& reached) const {
    return trace_baseline_rk34(spin, start, wanted, settings, steps, reached);
  }
};

//! Error that is counted for a ray that did not end within the step limit [rad].
inline constexpr float lost_ray_error = 1.0F;

//! Follows the rays of pixels to what they see. Index i covers the pixels i * lanes, i * lanes + 1,
//! ... of the block.
template <class Follower, class T>
struct FollowRays {
  FollowBatch batch;

  ERGO_HD void operator()(int index) const {
    using S = ScalarOf<T>;
    const PixelBatch& pixels = batch.pixels;
    const int first = index * RealTraits<T>::lane_count;
    const T zero(S(0));
    const T lost(static_cast<S>(lost_ray_error));
    T x_px;
    T y_px;
    pixel_middles(pixels, first, x_px, y_px);
    const T inside = image_coverage(pixels.projection, x_px, y_px);
    const S spin = pixels.camera.spin;
    const RayStart<T> start = start_ray(pixels.camera, part_of<T>(observed_direction(pixels, x_px, y_px)));
    const WayEnd<T> end = way_through_shells(spin, start, batch.shells, batch.shell_count);
    const auto shown = inside > zero;
    const auto to_shell = shown & end.meets;
    const auto to_sky = shown & (!end.meets) & comes_from_sky(spin, pixels.camera.horizon_r, start);
    T steps = zero;
    T error = zero;
    if (any(to_sky)) {
      MaskOf<T> reached = to_sky;
      const RayEnd<T> sky = Follower{}.to_sky(spin, start, to_sky, pixels.settings, steps, reached);
      error = select(to_sky, select(reached, sky.error_estimate, lost), zero);
    }
    if (any(to_shell)) {
      const FollowedRay<T> ray = Follower{}.to_radius(spin, start, end, to_shell, pixels.settings);
      steps = select(to_shell, ray.steps, steps);
      error = select(to_shell, select(ray.arrived, ray.error, lost), error);
    }
    const int count = pixel_count(pixels);
    store_lanes(pixels.out.coverage, first, count, select(to_shell | to_sky, inside, zero));
    store_lanes(pixels.out.error_estimate, first, count, error);
    store_lanes(pixels.out.steps, first, count, steps);
  }
};

//! Calls action(follower) with the follower of a method; does nothing for a method without steps.
template <class Action>
inline void dispatch_follower(TraceMethod method, const Action& action) {
  switch (method) {
    case TraceMethod::taylor:
      return action(FollowByTaylor{});
    case TraceMethod::rk34:
      return action(FollowByRungeKutta<RungeKutta34>{});
    case TraceMethod::cash_karp:
      return action(FollowByRungeKutta<CashKarp>{});
    case TraceMethod::baseline_rk34:
      return action(FollowByBaseline{});
    case TraceMethod::closed_form:
      return;
  }
}

template <class T, class Action>
void dispatch(const FollowBatch& batch, const Action& action) {
  dispatch_follower(batch.method, [&](auto follower) { action(FollowRays<decltype(follower), T>{batch}); });
}

}  // namespace ergodome::inline ERGO_TARGET
