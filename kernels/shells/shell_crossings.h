#pragma once

#include "kernels/near_rays/radial_fate.h"
#include "kernels/near_rays/series_search.h"

// Where light crosses spheres r = const, followed backwards from the camera, also inside the
// shadow.
namespace ergodome::inline ERGO_TARGET {

//! The shells that rays may cross, the outermost first.
template <class S>
struct ShellRadii {
  const S* u;  //!< 1/r of each shell, ascending [1/M]; all are outside the horizon
  int count;   //!< number of shells, at least one
};

//! A position on a ray.
template <class T>
struct NearPosition {
  T u;           //!< 1 / r [1/M]
  T u_rate;      //!< du/dλ (λ: Mino time), backwards: positive for light emitted outwards
  Vector3<T> m;  //!< direction from the hole's center without frame dragging, a unit vector
  //! Angle by which m must be rotated about the spin axis to point to the position, with φ = 0 at
  //! the camera or the head [rad].
  T drag;
  T delay;         //!< coordinate time from the position to the camera [M]; only if Parts include it
  T distance;      //!< affine distance from the camera [M]; only if Parts include it
  RealOf<T> time;  //!< Mino time from the position to the camera, for a photon seen with energy 1 [1/M]
};

namespace detail {

template <int Order, NearParts Parts, class T>
ERGO_HD NearPosition<T> position_at(const SeriesReading<T>& reading, const NearSeries<Order, T, Parts>& s, const T& h,
                                    const RealOf<T>& start) {
  NearPosition<T> position = {series_value(s.u, h),
                              series_rate(s.u, h) * reading.scale,
                              {series_value(s.x, h), series_value(s.y, h), series_value(s.z, h)},
                              series_value(s.drag, h),
                              T(ScalarOf<T>(0)),
                              T(ScalarOf<T>(0)),
                              start + value_of(h) / reading.scale};
  if constexpr (has_delay(Parts)) {
    position.delay = series_value(s.delay, h);
  }
  reading.count_outside(position.u, position.drag, position.delay);
  if constexpr (has_distance(Parts)) {
    position.distance = series_value(s.distance, h);
  }
  return position;
}

//! A part of a step in which r either only decreases or only increases.
template <class Real>
struct RadialLeg {
  Real from_h;
  Real to_h;
  Real from_u;
  Real to_u;
  MaskOf<Real> lanes;
};

//! Reports the crossings of a leg to the visitor, in order.
template <int Order, NearParts Parts, class T, class Visitor>
ERGO_HD void visit_leg(const NearSeries<Order, T, Parts>& s, const ShellRadii<ScalarOf<T>>& shells,
                       const RadialLeg<RealOf<T>>& leg, const SeriesReading<T>& reading, const RealOf<T>& start,
                       Visitor& visitor) {
  using S = ScalarOf<T>;
  using Real = RealOf<T>;
  for (int i = 0; i < 2 * shells.count; ++i) {
    const bool inwards = i < shells.count;
    const int shell = inwards ? i : 2 * shells.count - 1 - i;
    const Real side(inwards ? S(-1) : S(1));
    const Real u(shells.u[shell]);
    // A ray that begins on a shell does not cross it there.
    const auto crossed =
        leg.lanes & (inwards ? (leg.from_u < u) & !(leg.to_u < u) : (leg.from_u > u) & !(leg.to_u > u));
    if (any(crossed)) {
      T from_shell[Order + 1];
      from_shell[0] = s.u[0] - shells.u[shell];
      for (int k = 1; k <= Order; ++k) {
        from_shell[k] = s.u[k];
      }
      visitor.cross(shell, crossed,
                    position_at(reading, s, time_to_zero(from_shell, side, leg.from_h, leg.to_h), start));
    }
  }
}

//! Returns the time within a step at which r has its minimum or maximum.
template <int Order, class T>
ERGO_HD T time_to_turn(const T (&u)[Order], const RealOf<T>& side, const RealOf<T>& length) {
  using S = ScalarOf<T>;
  T rate[Order - 1];
  for (int k = 0; k + 1 < Order; ++k) {
    rate[k] = u[k + 1] * S(k + 1);
  }
  return time_to_zero(rate, side, RealOf<T>(S(0)), length);
}

}  // namespace detail

//! Follows rays backwards in time past all the shells that they cross, in order. Outside the
//! horizon light turns at most once, so it crosses a shell at most twice. A ray that begins on a
//! shell does not cross it there.
//!
//! The visitor has cross(shell, lanes, place), turn(lanes, place) where r turns, and done(), which
//! returns the lanes that are finished. Nothing is singular on the way, into or out of the horizon,
//! and rays end at the innermost shell at the latest, unless they turn. `active_at_start`: lanes to
//! trace. Returns false in lanes that reached the step limit. With dual numbers all derivatives are
//! exact.
template <int Order, NearParts Parts, class T, class Visitor>
ERGO_HD MaskOf<RealOf<T>> trace_shells(ScalarOf<T> spin, const NearRay<T>& ray, const ShellRadii<ScalarOf<T>>& shells,
                                       const NearLimits<ScalarOf<T>>& limits, const MaskOf<RealOf<T>>& active_at_start,
                                       Visitor& visitor) {
  static_assert(has_azimuth(Parts));
  using S = ScalarOf<T>;
  using Real = RealOf<T>;
  const Real zero(S(0));
  const Real outermost(shells.u[0]);
  const Real innermost(shells.u[shells.count - 1]);
  const RadialFate<Real> fate = radial_fate(spin, ray);
  const Real scale =
      safe_sqrt(maximum(value_of(ray.polar_constant), zero)) + maximum(absolute(value_of(ray.energy)), Real(S(1)));
  const Real inverse_scale = Real(S(1)) / scale;
  const detail::NearCoefficients<T> coefficients = detail::near_coefficients(spin, ray, inverse_scale);
  detail::NearSeries<Order, T, Parts> s;
  detail::start_series(ray, inverse_scale, s);
  const SeriesReading<T> reading = {spin, coefficients.ingoing, scale};
  Real time = zero;
  Real u = value_of(s.u[0]);
  const auto leaves_no_shell = [&](const Real& rate) {
    return (keeps_inwards(fate, u, rate) & (u >= innermost)) | (keeps_outwards(fate, u, rate) & (u <= outermost));
  };
  MaskOf<Real> active = active_at_start & !leaves_no_shell(value_of(s.u[1])) & has_been_outside(spin, ray);
  for (int step = 0; step < limits.step_limit && any(active); ++step) {
    detail::expand_near(spin, ray, coefficients, s);
    const Real length = detail::near_step(s, scale, limits.tolerance);
    const Real rate = value_of(s.u[1]);
    const Real end_rate = value_of(series_rate(s.u, length));
    const Real end_u = value_of(series_value(s.u, length));
    const MaskOf<Real> turning = active & (rate * end_rate < zero);
    detail::RadialLeg<Real> leg = {zero, length, u, end_u, active};
    if (any(turning)) {
      const T turn = detail::time_to_turn(s.u, rate, length);
      const NearPosition<T> position = detail::position_at(reading, s, turn, time);
      leg.to_h = select(turning, value_of(turn), length);
      leg.to_u = select(turning, value_of(position.u), end_u);
      detail::visit_leg(s, shells, leg, reading, time, visitor);
      visitor.turn(turning, position);
      leg = {leg.to_h, length, leg.to_u, end_u, turning};
    }
    detail::visit_leg(s, shells, leg, reading, time, visitor);
    time = time + length * inverse_scale;
    detail::move_series(s, length);
    u = end_u;
    active = active & !leaves_no_shell(end_rate) & !visitor.done();
  }
  return !active;
}

}  // namespace ergodome::inline ERGO_TARGET
