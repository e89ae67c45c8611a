#pragma once

#include "kernels/disk/crossing_series.h"

// Where light crosses the equatorial plane, followed backwards from the camera, also inside the
// shadow.
namespace ergodome::inline ERGO_TARGET {

//! Number of crossings that are kept: the direct image of the plane, the image by light that passes
//! under the hole, and the next image.
inline constexpr int crossing_orders = 3;

//! Limits for following rays to the equatorial plane: where they end, their precision and their
//! number of steps.
template <class S>
struct CrossingLimits {
  //! Outgoing light with a 1/r below this, which is well below that of the photon orbits, does not
  //! come back. With the delay, rays end there; without it, they go on a little past infinity.
  S outermost_u;
  S tolerance;  //!< maximum local error of a step, as an angle [rad]
  int step_limit;
};

namespace detail {

//! Range of u = 1/r in which crossings are sought, and where rays end.
template <class S>
struct CrossingBounds {
  S horizon_r;
  S min_u;  //!< only crossings with u between min_u and max_u count
  S max_u;
  S innermost_u;  //!< rays end beyond this u, except on their way out of the horizon
  S outermost_u;  //!< outgoing rays end at this u
};

//! Returns the bounds of a hole. With the delay, rays end before the horizon, where time and
//! azimuth diverge and light is frozen and dark. Without it, rays go on a little past infinity and
//! past the horizon, so that a pixel whose light just misses the plane still gets a u. From it, the
//! fraction of the pixel that the disk covers is computed.
template <bool WithDelay, class S>
ERGO_HD CrossingBounds<S> crossing_bounds(S spin, S outermost_u) {
  const S horizon_r = kerr_horizon_radius(spin);
  if constexpr (WithDelay) {
    constexpr S margin = S(sizeof(S) == 4 ? 1e-4 : 1e-9);
    return {horizon_r, S(0), S(1) / horizon_r, (S(1) - margin) / horizon_r, outermost_u};
  } else {
    constexpr S beyond = S(0.2);
    return {horizon_r, -beyond, S(1.5) / horizon_r, S(1.5) / horizon_r, -beyond};
  }
}

}  // namespace detail

//! Follows rays to their first crossings of the equatorial plane outside the horizon, in order; the
//! camera may be within it. Rays that stay in the plane have none. Without WithDelay, a crossing
//! past infinity or behind the horizon is stored as well (EquatorialCrossing::u).
//!
//! `active_at_start`: lanes to trace. `WithDelay`: computes azimuth and time; without them nothing
//! is singular at the horizon or at infinity, and steps are longer. Returns false in lanes that
//! reached the step limit. With dual numbers all derivatives are exact.
template <int Order, bool WithDelay, class T>
ERGO_HD MaskOf<RealOf<T>> trace_crossings(ScalarOf<T> spin, const NearRay<T>& ray,
                                          const CrossingLimits<ScalarOf<T>>& limits,
                                          const MaskOf<RealOf<T>>& active_at_start,
                                          EquatorialCrossing<T> (&crossings)[crossing_orders]) {
  using S = ScalarOf<T>;
  using Real = RealOf<T>;
  const Real zero(S(0));
  const T none(zero);
  for (EquatorialCrossing<T>& crossing : crossings) {
    crossing = {none, none, none, none, none, none, zero};
  }
  const detail::CrossingBounds<S> bounds = detail::crossing_bounds<WithDelay>(spin, limits.outermost_u);
  const Real scale =
      safe_sqrt(maximum(value_of(ray.polar_constant), zero)) + maximum(absolute(value_of(ray.energy)), Real(S(1)));
  const Real inverse_scale = Real(S(1)) / scale;
  const detail::NearCoefficients<T> coefficients = detail::near_coefficients(spin, ray, inverse_scale);
  detail::NearSeries<Order, T, detail::disk_parts(WithDelay)> s;
  detail::start_series(ray, inverse_scale, s);
  const SeriesReading<T> reading = {spin, coefficients.ingoing, scale};
  Real side = detail::side_of(value_of(s.z[0]), detail::side_of(value_of(s.z[1]), zero));
  Real count(S(0));
  Real time(S(0));
  auto fallen = zero > zero;
  auto active = active_at_start & ((side > zero) | (side < zero)) & has_been_outside(spin, ray);
  // Rays from a camera within the horizon start on their way out of it. Crossings before they leave
  // the horizon do not count, and do not end the ray.
  const Real out_of_horizon(minimum(bounds.innermost_u, S(1) / bounds.horizon_r));
  auto emerging = (value_of(s.u[0]) > out_of_horizon) & (value_of(s.u[1]) < zero);
  for (int step = 0; step < limits.step_limit && any(active); ++step) {
    detail::expand_near(spin, ray, coefficients, s);
    const Real length = detail::near_step(s, scale, limits.tolerance);
    const Real new_side = detail::side_of(value_of(series_value(s.z, length)), side);
    const auto crossed = active & (new_side * side < zero);
    const auto falls = detail::falls_within(s, length, bounds.horizon_r) & !emerging;
    // If a ray moves outwards at the start of a step in which it falls, it crosses the plane on its
    // way out, before the fall.
    const auto fell = fallen | (falls & (value_of(s.u[1]) > zero));
    fallen = fallen | falls;
    if (any(crossed)) {
      const auto crossing = detail::crossing_at(reading, s, detail::time_to_zero(s.z, side, zero, length), time);
      const Real u = value_of(crossing.u);
      // Light that has left does not come back. The equations continue smoothly past infinity and
      // return from there; crossings after that do not count.
      const auto leaving = (value_of(s.u[1]) < zero) & (value_of(s.u[0]) < Real(limits.outermost_u));
      const auto back = leaving & (value_of(crossing.u_rate) > zero);
      const auto out_of_hole = fell & (value_of(crossing.u_rate) < zero);
      const Real max_u = select(emerging, out_of_horizon, Real(bounds.max_u));
      const auto outside = crossed & (!(back | out_of_hole)) & (u > Real(bounds.min_u)) & (u < max_u);
      for (int order = 0; order < crossing_orders; ++order) {
        const Real beyond = count - static_cast<S>(order);
        detail::keep_crossing(outside & (absolute(beyond) < Real(S(0.5))), crossing, crossings[order]);
      }
      count = select(outside, count + S(1), count);
      // A crossing behind the horizon is stored, as it shows how nearly the ray crossed the plane
      // outside. The ray ends there, since later crossings are meaningless.
      active = active & !(outside & (u * bounds.horizon_r > Real(S(1))));
    }
    time = time + length * inverse_scale;
    detail::move_series(s, length);
    side = new_side;
    const Real u = value_of(s.u[0]);
    const auto outwards = value_of(s.u[1]) < zero;
    const auto within = emerging & (u > out_of_horizon);
    emerging = within & outwards;
    fallen = fallen | (within & !outwards);
    const auto gone = (outwards & (u < Real(bounds.outermost_u))) | ((!outwards) & (u < zero)) | (fallen & outwards);
    const auto going = (u > Real(bounds.min_u)) & ((u < Real(bounds.innermost_u)) | emerging) & !gone;
    active = active & going & (count < Real(S(crossing_orders - 0.5)));
  }
  return !active;
}

}  // namespace ergodome::inline ERGO_TARGET
