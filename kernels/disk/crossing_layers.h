#pragma once

#include "kernels/core/dual.h"
#include "kernels/disk/equatorial_crossings.h"
#include "kernels/disk/layer_limits.h"
#include "kernels/disk/lost_winding.h"

// Where light crosses the equatorial plane, as functions of its direction that are smooth wherever
// the disk may be seen.
//
// The Mino time at which light crosses the plane depends only on its polar motion, and is finite.
// So 1/r at the n-th crossing is a smooth function of the direction, even across the boundary
// between light that the hole captures and light that escapes, if 1/r is continued beyond the range
// in which the equation of motion is followed (LayerLimits). Once light goes inwards past the
// radius below which no light turns, or outwards past the disk, its 1/r, azimuth and time continue
// at constant rates ("straight"), as if no force acted. Values and first derivatives are continuous
// where this continuation begins, and nothing diverges at the horizon or far out.
namespace ergodome::inline ERGO_TARGET {

//! The crossing of one order. If u would be outside [lowest_u, highest_u] of LayerLimits, it is the
//! nearer of these bounds, and its derivatives are 0.
template <class T>
struct CrossingLayer {
  T u;  //!< 1 / r [1/M]
  //! Cosine and sine of the crossing's Boyer-Lindquist azimuth relative to the camera's, minus the
  //! winding at u (horizon_winding.h). Only computed if the disk has a pattern.
  T cosine;
  T sine;
  //! Coordinate time from emission to the camera, minus the time of the winding [M]. Only computed
  //! if the disk has a pattern.
  T delay;
  T distance;  //!< affine distance from the camera [M]; only if Parts include it
  //! Rate du/dλ along the ray, followed backwards: positive for light emitted outwards. Only
  //! computed with the distance.
  RealOf<T> u_rate;
};

namespace detail {

//! Constant rates of a ray's quantities on its straight continuation.
template <class T>
struct StraightRates {
  T drag;
  T delay;
  T distance;
};

//! Replaces the series of lanes on their straight continuation: u is linear, and the other
//! quantities change at the constant `rates`.
template <int Order, class T, NearParts Parts>
ERGO_HD void straighten(const MaskOf<RealOf<T>>& straight, const StraightRates<T>& rates,
                        NearSeries<Order, T, Parts>& s) {
  const T none(RealOf<T>(ScalarOf<T>(0)));
  ERGO_UNROLL
  for (int k = 2; k <= Order; ++k) {
    s.u[k] = select(straight, none, s.u[k]);
  }
  if constexpr (has_delay(Parts)) {
    ERGO_UNROLL
    for (int k = 1; k <= Order; ++k) {
      s.drag[k] = select(straight, k == 1 ? rates.drag : none, s.drag[k]);
      s.delay[k] = select(straight, k == 1 ? rates.delay : none, s.delay[k]);
    }
  }
  if constexpr (has_distance(Parts)) {
    ERGO_UNROLL
    for (int k = 1; k <= Order; ++k) {
      s.distance[k] = select(straight, k == 1 ? rates.distance : none, s.distance[k]);
    }
  }
}

//! Returns the h (scaled Mino time within a step) at which a series is zero. A last Newton step
//! makes the mixed derivative of h exact, too.
template <int Order, class T>
ERGO_HD T exact_time_to_zero(const T (&c)[Order], const RealOf<T>& side, const RealOf<T>& to) {
  const RealOf<T> start(ScalarOf<T>(0));
  const T h = time_to_zero(c, side, start, to);
  if constexpr (has_mixed_part<T>) {
    return h - series_value(c, h) / series_rate(c, h);
  } else {
    return h;
  }
}

//! Returns a layer of which only u = 1/r is known.
template <class T>
ERGO_HD CrossingLayer<T> empty_layer(const T& u) {
  const RealOf<T> zero(ScalarOf<T>(0));
  const T none(zero);
  return {u, none, none, none, none, zero};
}

//! Reads a layer from the series at the h where the light crosses the equatorial plane. In lanes on
//! a straight continuation, the winding has already been subtracted at the start of the
//! continuation.
template <int Order, class T, NearParts Parts>
ERGO_HD CrossingLayer<T> layer_at(const LostWinding<T>& lost, const MaskOf<RealOf<T>>& straight,
                                  const NearSeries<Order, T, Parts>& s, const T& h) {
  const T none(RealOf<T>(ScalarOf<T>(0)));
  CrossingLayer<T> layer = empty_layer(series_value(s.u, h));
  if constexpr (has_delay(Parts)) {
    const T x = series_value(s.x, h);
    const T y = series_value(s.y, h);
    T sine;
    T cosine;
    const T wound = select(straight, none, winding(lost.horizon, layer.u));
    sine_cosine(series_value(s.drag, h) - lost.turn * wound, sine, cosine);
    layer.cosine = x * cosine - y * sine;
    layer.sine = x * sine + y * cosine;
    layer.delay = series_value(s.delay, h) - lost.delay * wound;
  }
  if constexpr (has_distance(Parts)) {
    layer.distance = series_value(s.distance, h);
    layer.u_rate = value_of(series_rate(s.u, h));
  }
  return layer;
}

template <class Mask, class T>
ERGO_HD void keep_layer(const Mask& mask, const CrossingLayer<T>& from, CrossingLayer<T>& to) {
  to = {select(mask, from.u, to.u),
        select(mask, from.cosine, to.cosine),
        select(mask, from.sine, to.sine),
        select(mask, from.delay, to.delay),
        select(mask, from.distance, to.distance),
        select(mask, from.u_rate, to.u_rate)};
}

//! Returns a ray that crosses the equatorial plane where neighboring rays do. If the ray starts in
//! the plane, its vertical rate keeps its sign but gets a minimum size, too small to affect the
//! picture. Other rays stay unchanged.
template <class T>
ERGO_HD NearRay<T> off_the_plane(const NearRay<T>& ray) {
  using S = ScalarOf<T>;
  using Real = RealOf<T>;
  const Real zero(S(0));
  const Real min_value = S(sizeof(S) == 4 ? 1e-2 : 1e-4) * safe_sqrt(maximum(value_of(ray.polar_constant), zero));
  const Real rate = value_of(ray.m_rate.z);
  const Real lift = select(rate < zero, minimum(rate, -min_value), maximum(rate, min_value)) - rate;
  const auto within = absolute(value_of(ray.m.z)) < Real(std::numeric_limits<S>::min());
  NearRay<T> lifted = ray;
  lifted.m_rate.z = ray.m_rate.z + select(within, lift, zero);
  return lifted;
}

//! State of a pack of rays while they are followed to their crossings of the equatorial plane.
template <class T>
struct LayerState {
  using Real = RealOf<T>;
  using Mask = MaskOf<Real>;

  Mask active;
  Mask straight;
  Real side;   //!< side of the equatorial plane on which the ray is now: sign of z
  Real count;  //!< number of crossings of the equatorial plane so far
  StraightRates<T> rates;
};

//! Returns where a step ends: at `length`, or earlier where 1/r leaves the range of LayerLimits.
//! `leaves` receives the lanes that continue straight from the end of this step.
template <int Order, class T, NearParts Parts>
ERGO_HD T end_of_step(const NearSeries<Order, T, Parts>& s, const LayerLimits<ScalarOf<T>>& limits,
                      const RealOf<T>& length, const LayerState<T>& state, MaskOf<RealOf<T>>& leaves) {
  using S = ScalarOf<T>;
  using Real = RealOf<T>;
  const Real zero(S(0));
  const Real begin = value_of(s.u[0]);
  const Real end = value_of(series_value(s.u, length));
  const Real rate = value_of(series_rate(s.u, length));
  const auto inwards = (end > Real(limits.near_u)) & (rate > zero);
  const auto outwards = (end < Real(limits.far_u)) & (rate < zero);
  leaves = (inwards | outwards) & (!state.straight) & state.active;
  // A lane whose 1/r was beyond the bound already at the start of the step has turned there, far
  // from the disk. Its straight continuation starts at the end of the step.
  const Real bound = select(inwards, Real(limits.near_u), Real(limits.far_u));
  const auto passes = leaves & ((inwards & (begin < bound)) | (outwards & (begin > bound)));
  if (!any(passes)) {
    return T(length);
  }
  T beyond[Order + 1];
  ERGO_UNROLL
  for (int k = 0; k <= Order; ++k) {
    beyond[k] = s.u[k];
  }
  beyond[0] = s.u[0] - bound;
  const T exit = exact_time_to_zero(beyond, select(inwards, Real(S(-1)), Real(S(1))), length);
  return select(passes, exit, T(length));
}

//! Subtracts the winding from azimuth and time in the lanes that continue straight from h = 0 of
//! the series. `kept` receives the constant rates of these lanes.
template <int Order, class T, NearParts Parts>
ERGO_HD void unwind(const LostWinding<T>& lost, const MaskOf<RealOf<T>>& leaves, const StraightRates<T>& rates,
                    NearSeries<Order, T, Parts>& s, StraightRates<T>& kept) {
  const T wound = winding(lost.horizon, s.u[0]);
  const T rate = winding_rate(lost.horizon, s.u[0]) * s.u[1];
  s.drag[0] = select(leaves, s.drag[0] - lost.turn * wound, s.drag[0]);
  s.delay[0] = select(leaves, s.delay[0] - lost.delay * wound, s.delay[0]);
  kept.drag = select(leaves, rates.drag - lost.turn * rate, kept.drag);
  kept.delay = select(leaves, rates.delay - lost.delay * rate, kept.delay);
}

//! If a lane crosses the equatorial plane during a step, stores the crossing as the layer of its
//! order and counts it.
template <int Order, class T, NearParts Parts>
ERGO_HD void meet_plane(const LostWinding<T>& lost, const NearSeries<Order, T, Parts>& s, const RealOf<T>& length,
                        LayerState<T>& state, CrossingLayer<T> (&layers)[crossing_orders]) {
  using S = ScalarOf<T>;
  using Real = RealOf<T>;
  const Real zero(S(0));
  const Real side = side_of(value_of(series_value(s.z, length)), state.side);
  const auto crossed = state.active & (side * state.side < zero);
  if (any(crossed)) {
    const CrossingLayer<T> layer = layer_at(lost, state.straight, s, exact_time_to_zero(s.z, state.side, length));
    for (int order = 0; order < crossing_orders; ++order) {
      keep_layer(crossed & (absolute(state.count - static_cast<S>(order)) < Real(S(0.5))), layer, layers[order]);
    }
    state.count = select(crossed, state.count + S(1), state.count);
  }
  state.side = side;
}

//! Ends lanes that have `orders` crossings, and lanes whose straight continuation has left
//! [lowest_u, highest_u]. The missing crossings of the latter get the bound as their u.
template <class T>
ERGO_HD void end_layers(const T& u, const T& distance, const LayerLimits<ScalarOf<T>>& limits, int orders,
                        LayerState<T>& state, CrossingLayer<T> (&layers)[crossing_orders]) {
  using S = ScalarOf<T>;
  using Real = RealOf<T>;
  const auto high = value_of(u) > Real(limits.highest_u);
  const auto done = state.active & state.straight & (high | (value_of(u) < Real(limits.lowest_u)));
  if (any(done)) {
    CrossingLayer<T> beyond = empty_layer(select(high, T(Real(limits.highest_u)), T(Real(limits.lowest_u))));
    beyond.distance = distance;
    for (int order = 0; order < crossing_orders; ++order) {
      const auto missing = done & (state.count < Real(S(order + 0.5)));
      keep_layer(missing, beyond, layers[order]);
    }
  }
  state.active = state.active & (!done) & (state.count < Real(static_cast<S>(orders) - S(0.5)));
}

}  // namespace detail

//! Follows rays to their first `orders` crossings of the equatorial plane, wherever these are.
//! `Parts` selects the quantities that are computed in addition to 1/r.
//!
//! Returns false in lanes that reached the step limit. With MixedDual numbers all derivatives are
//! exact.
template <int Order, NearParts Parts, class T>
ERGO_HD MaskOf<RealOf<T>> trace_layers(ScalarOf<T> spin, const NearRay<T>& start,
                                       const LayerLimits<ScalarOf<T>>& limits,
                                       CrossingLayer<T> (&layers)[crossing_orders], int orders = crossing_orders) {
  using S = ScalarOf<T>;
  using Real = RealOf<T>;
  const Real zero(S(0));
  const T none(zero);
  const NearRay<T> ray = detail::off_the_plane(start);
  const auto sees = has_been_outside(spin, ray);
  const auto within = begins_within(spin, ray);
  for (CrossingLayer<T>& layer : layers) {
    // Light within the horizon that never was outside has no neighboring light that comes from far
    // away, so its layers get highest_u, the bound inside the horizon.
    layer = detail::empty_layer(T(select(sees, Real(limits.lowest_u), Real(limits.highest_u))));
  }
  const Real scale =
      safe_sqrt(maximum(value_of(ray.polar_constant), zero)) + maximum(absolute(value_of(ray.energy)), Real(S(1)));
  const Real inverse_scale = Real(S(1)) / scale;
  const detail::NearCoefficients<T> coefficients = detail::near_coefficients(spin, ray, inverse_scale);
  detail::NearSeries<Order, T, Parts> s;
  detail::start_series(ray, inverse_scale, s);
  const detail::LostWinding<T> lost(horizon_winding(spin, any(within)), coefficients.ingoing);
  const Real side = detail::side_of(value_of(s.z[0]), detail::side_of(value_of(s.z[1]), Real(S(1))));
  detail::LayerState<T> state = {sees, zero > zero, side, zero, {none, none, none}};
  for (int step = 0; step < limits.step_limit && any(state.active); ++step) {
    detail::expand_near(spin, ray, coefficients, s);
    detail::straighten(state.straight, state.rates, s);
    const Real length = detail::near_step(s, scale, limits.tolerance);
    MaskOf<Real> leaves = zero > zero;
    const T h = detail::end_of_step(s, limits, length, state, leaves);
    detail::meet_plane(lost, s, value_of(h), state, layers);
    detail::StraightRates<T> rates = {none, none, none};
    if constexpr (has_delay(Parts)) {
      rates = {series_rate(s.drag, h), series_rate(s.delay, h), none};
    }
    if constexpr (has_distance(Parts)) {
      state.rates.distance = select(leaves, series_rate(s.distance, h), state.rates.distance);
    }
    detail::move_series(s, h);
    if constexpr (has_delay(Parts)) {
      if (any(leaves)) {
        detail::unwind(lost, leaves, rates, s, state.rates);
      }
    }
    state.straight = state.straight | leaves;
    detail::end_layers(s.u[0], detail::distance_so_far(s), limits, orders, state, layers);
  }
  return !state.active;
}

}  // namespace ergodome::inline ERGO_TARGET
