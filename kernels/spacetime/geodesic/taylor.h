#pragma once

#include "kernels/spacetime/geodesic/integration.h"

// Taylor series of Kerr's null geodesics in Mino time. The equations are polynomial, except for one
// division for the frame dragging, so the coefficients follow from convolutions of lower ones
// (Jorba & Zou, Experimental Mathematics 14 (2005) 99).
namespace ergodome::inline ERGO_TARGET {

//! Constants of one ray, in the form that the recurrences use.
//!
//! Time is Mino time times s = √C + 1, so that the series remains near 1 in size and does not
//! overflow in float, however far the camera is: at r = 10⁶ the tenth derivative in plain Mino time
//! would be 10⁶⁰.
template <class T>
struct TaylorCoefficients {
  T u_linear;                 //!< (a² - C) / s²; s: see TaylorCoefficients
  T u_quadratic;              //!< 3 K / s²
  T u_cubic;                  //!< -2 a² Q / s²
  T polar;                    //!< C / s²
  T drag_u;                   //!< -2 a / s: factor of u in the numerator of ψ', backwards
  T drag_u2;                  //!< a² L / s: factor of u² in the numerator of ψ', backwards
  RealOf<T> spin2;            //!< a² / s²
  ScalarOf<T> outer_horizon;  //!< radius of the outer horizon, r_+ [M]
  //! As in RayStart. For lanes whose light moves only inwards, the members below have other values,
  //! which put X + √R in place of Δ (drag_rate() in runge_kutta.h).
  bool ingoing;
  RealOf<T> lapse_u;     //!< factor of u in Δ u²: -2; 0 for light that moves only inwards
  T lapse_u2;            //!< factor of u²: a²; a² - a L for light that moves only inwards
  RealOf<T> lapse_rate;  //!< factor of du/dh: 0; -s for light that moves only inwards, s = √C + 1
  //! 0; a / s for light that moves only inwards (drag_u is then 0 and drag_u2 is -a K / s).
  RealOf<T> drag_lapse;
};

//! Computes the constants of a ray. `inverse_scale` is 1 / s.
template <class T>
ERGO_HD TaylorCoefficients<T> taylor_coefficients(ScalarOf<T> spin, const RayStart<T>& ray,
                                                  const RealOf<T>& inverse_scale) {
  using S = ScalarOf<T>;
  using Real = RealOf<T>;
  const S a2 = spin * spin;
  const Real square = inverse_scale * inverse_scale;
  const T carter = ray.polar_constant - ray.axial_angular_momentum * ray.axial_angular_momentum;
  TaylorCoefficients<T> c = {(a2 - ray.polar_constant) * square,
                             ray.shear_constant * (S(3) * square),
                             carter * (square * (-S(2) * a2)),
                             ray.polar_constant * square,
                             T(inverse_scale * (-S(2) * spin)),
                             ray.axial_angular_momentum * (inverse_scale * a2),
                             square * a2,
                             S(1) + safe_sqrt(S(1) - a2),
                             ray.ingoing,
                             Real(-S(2)),
                             T(a2),
                             Real(S(0)),
                             Real(S(0))};
  if (ray.ingoing) {
    const MaskOf<Real> in = only_comes_in(ray);
    c.drag_u = select(in, T(S(0)), c.drag_u);
    c.drag_u2 = select(in, ray.shear_constant * (inverse_scale * -spin), c.drag_u2);
    c.lapse_u = select(in, Real(S(0)), c.lapse_u);
    c.lapse_u2 = select(in, a2 - spin * ray.axial_angular_momentum, c.lapse_u2);
    c.lapse_rate = select(in, Real(S(-1)) / inverse_scale, c.lapse_rate);
    c.drag_lapse = select(in, inverse_scale * spin, c.drag_lapse);
  }
  return c;
}

//! The series of one step: coefficient k belongs to h^k.
template <int Order, class T>
struct TaylorSeries {
  T u[Order + 1];
  T x[Order + 1];
  T y[Order + 1];
  T z[Order + 1];
  T drag[Order + 1];
};

namespace detail {
//! Returns coefficient k of f g.
template <class T>
ERGO_HD T product_coefficient(const T* f, const T* g, int k) {
  T sum = f[0] * g[k];
  ERGO_UNROLL
  for (int i = 1; i <= k; ++i) {
    sum = sum + f[i] * g[k - i];
  }
  return sum;
}

//! Returns coefficient k of f², with each product computed once.
template <class T>
ERGO_HD T square_coefficient(const T* f, int k) {
  using S = ScalarOf<T>;
  if (k == 0) {
    return f[0] * f[0];
  }
  T half = f[0] * f[k];
  ERGO_UNROLL
  for (int i = 1; 2 * i < k; ++i) {
    half = half + f[i] * f[k - i];
  }
  const T sum = half + half;
  return k % 2 == 0 ? sum + f[k / 2] * f[k / 2] : sum * S(1);
}
}  // namespace detail

//! Fills the series from the state at h = 0. Rates and h are in the scaled time of the
//! coefficients.
//!
//! The equations are those of rate_of() and drag_rate() in runge_kutta.h. `bend` (B) is -(C + 2 a²
//! m_z²).
template <int Order, class T>
ERGO_HD void expand(ScalarOf<T> spin, const TaylorCoefficients<T>& c, const RayState<T>& state,
                    TaylorSeries<Order, T>& s) {
  using S = ScalarOf<T>;
  using Real = RealOf<T>;
  const S a2 = spin * spin;
  T square[Order + 1];  // u²
  T force[Order + 1];   // u'' / u
  T bend[Order + 1];    // B
  T lapse[Order + 1];   // Δ u²; if `ingoing`, (X + √R) u²
  T drag_rate[Order + 1];
  s.u[0] = state.u;
  s.u[1] = state.u_rate;
  s.x[0] = state.m.x;
  s.x[1] = state.m_rate.x;
  s.y[0] = state.m.y;
  s.y[1] = state.m_rate.y;
  s.z[0] = state.m.z;
  s.z[1] = state.m_rate.z;
  s.drag[0] = state.drag;
  T inverse_lapse(S(1));
  ERGO_UNROLL
  for (int k = 0; k < Order; ++k) {
    square[k] = detail::square_coefficient(s.u, k);
    T drag_sum = c.drag_u * s.u[k] + c.drag_u2 * square[k];
    if (c.ingoing) {
      lapse[k] = c.lapse_u2 * square[k] + s.u[k] * c.lapse_u + s.u[k + 1] * (c.lapse_rate * S(k + 1));
    } else {
      lapse[k] = a2 * square[k] - S(2) * s.u[k];
    }
    if (k == 0) {
      // 1 - 2u + a² u² loses all digits next to an extremal horizon, so it is computed as the
      // product of its factors.
      const T by_factors = (S(1) - c.outer_horizon * s.u[0]) * (S(1) - (a2 / c.outer_horizon) * s.u[0]);
      lapse[0] = c.ingoing ? select(c.lapse_rate < Real(S(0)), lapse[0] + S(1), by_factors) : by_factors;
    }
    if (c.ingoing) {
      drag_sum = drag_sum + lapse[k] * c.drag_lapse;
    }
    if (k == 0) {
      inverse_lapse = Real(S(1)) / lapse[0];
    }
    ERGO_UNROLL
    for (int i = 1; i <= k; ++i) {
      drag_sum = drag_sum - lapse[i] * drag_rate[k - i];
    }
    drag_rate[k] = drag_sum * inverse_lapse;
    s.drag[k + 1] = drag_rate[k] * S(1.0 / (k + 1));
    if (k + 2 > Order) {
      continue;
    }
    force[k] = c.u_quadratic * s.u[k] + c.u_cubic * square[k];
    bend[k] = detail::square_coefficient(s.z, k) * (S(-2) * c.spin2);
    if (k == 0) {
      force[0] = force[0] + c.u_linear;
      bend[0] = bend[0] - c.polar;
    }
    const S share = S(1.0 / ((k + 1) * (k + 2)));
    s.u[k + 2] = detail::product_coefficient(force, s.u, k) * share;
    s.x[k + 2] = detail::product_coefficient(bend, s.x, k) * share;
    s.y[k + 2] = detail::product_coefficient(bend, s.y, k) * share;
    s.z[k + 2] = (detail::product_coefficient(bend, s.z, k) + s.z[k] * c.spin2) * share;
  }
}

//! Returns the value of a series at h.
template <int Order, class T, class Step>
ERGO_HD T series_value(const T (&c)[Order], const Step& h) {
  T sum = c[Order - 1];
  ERGO_UNROLL
  for (int k = Order - 2; k >= 0; --k) {
    sum = sum * h + c[k];
  }
  return sum;
}

//! Returns the derivative of a series by h, at h.
template <int Order, class T, class Step>
ERGO_HD T series_rate(const T (&c)[Order], const Step& h) {
  using S = ScalarOf<T>;
  T sum = c[Order - 1] * S(Order - 1);
  ERGO_UNROLL
  for (int k = Order - 2; k >= 1; --k) {
    sum = sum * h + c[k] * S(k);
  }
  return sum;
}

//! Returns the state at h.
template <int Order, class T, class Step>
ERGO_HD RayState<T> evaluate(const TaylorSeries<Order, T>& s, const Step& h) {
  return {series_value(s.u, h),
          series_rate(s.u, h),
          {series_value(s.x, h), series_value(s.y, h), series_value(s.z, h)},
          {series_rate(s.x, h), series_rate(s.y, h), series_rate(s.z, h)},
          series_value(s.drag, h)};
}

namespace detail {
//! Returns the size of the terms of power k as an error of the sky direction; u counts through the
//! shift of Mino time that it causes.
template <int Order, class T>
ERGO_HD RealOf<T> term_size(const TaylorSeries<Order, T>& s, int k, const RealOf<T>& polar_speed) {
  return absolute(value_of(s.x[k])) + absolute(value_of(s.y[k])) + absolute(value_of(s.z[k])) +
         absolute(value_of(s.drag[k])) + polar_speed * absolute(value_of(s.u[k]));
}

template <class Real, class T>
ERGO_HD void assign_where(const MaskOf<Real>& mask, RayState<T>& to, const RayState<T>& from) {
  to.u = select(mask, from.u, to.u);
  to.u_rate = select(mask, from.u_rate, to.u_rate);
  to.m = {select(mask, from.m.x, to.m.x), select(mask, from.m.y, to.m.y), select(mask, from.m.z, to.m.z)};
  to.m_rate = {select(mask, from.m_rate.x, to.m_rate.x), select(mask, from.m_rate.y, to.m_rate.y),
               select(mask, from.m_rate.z, to.m_rate.z)};
  to.drag = select(mask, from.drag, to.drag);
}

//! Returns the step length at which the last two terms stay within the tolerance. Where a ray is
//! symmetric in time about the start of the step, terms may vanish, even the last two at once:
//! about the turning point at r = 6 of a hole without spin, u has only every fourth term. High
//! orders, which take few long steps, also use the two terms before, as an estimate of the radius
//! of convergence.
template <int Order, class T>
ERGO_HD RealOf<T> step_length(const TaylorSeries<Order, T>& series, const RealOf<T>& tolerance,
                              const RealOf<T>& polar_speed) {
  using S = ScalarOf<T>;
  using Real = RealOf<T>;
  const Real tiny(std::numeric_limits<S>::min() * S(1e6));
  const auto size = [&](int k) { return term_size(series, k, polar_speed) + tiny; };
  Real length = minimum(rough_power(tolerance / size(Order), S(1.0 / Order)),
                        rough_power(tolerance / size(Order - 1), S(1.0 / (Order - 1))));
  if constexpr (Order > 10) {
    const Real part = rough_power(tolerance, S(1.0 / Order));
    length = minimum(length, part * minimum(rough_power(S(1) / size(Order - 2), S(1.0 / (Order - 2))),
                                            rough_power(S(1) / size(Order - 3), S(1.0 / (Order - 3)))));
  }
  return length;
}

//! Returns the h in (0, within] at which a ray reaches infinity, u(h) = 0; the derivatives of a
//! dual number are exact, too.
template <int Order, class T>
ERGO_HD T time_to_infinity(const TaylorSeries<Order, T>& s, const RealOf<T>& within) {
  using Real = RealOf<T>;
  using S = ScalarOf<T>;
  Real u[Order + 1];
  ERGO_UNROLL
  for (int k = 0; k <= Order; ++k) {
    u[k] = value_of(s.u[k]);
  }
  // Outgoing light is nearly straight in (λ, u), so the tangent at the start is a good first guess.
  // If the ray still moves inwards at the start of its last step, the end of the step is the guess.
  const Real tangent = -(u[0] / select(u[1] < Real(S(0)), u[1], Real(S(-1))));
  Real h = select(u[1] < Real(S(0)), minimum(tangent, within), within);
  constexpr int rounds = sizeof(S) == 4 ? 4 : 5;
  for (int round = 0; round < rounds; ++round) {
    const Real next = h - series_value(u, h) / series_rate(u, h);
    h = select((next > Real(S(0))) & (next < within), next, h);
  }
  // One round of Newton's method on the dual number makes its first derivatives exact; a second
  // round makes the mixed derivative exact.
  T exact = T(h) - series_value(s.u, T(h)) / series_rate(s.u, T(h));
  if constexpr (has_mixed_part<T>) {
    exact = exact - series_value(s.u, exact) / series_rate(s.u, exact);
  }
  return exact;
}
}  // namespace detail

//! Follows a ray that is known to come from the sky to its end, by Taylor series of the given
//! order.
//!
//! `active_at_start` selects the lanes to trace. `steps` receives the number of steps of each lane,
//! `reached` the lanes that arrived within the step limit. With dual numbers all derivatives are
//! exact derivatives of the computed map, including the last step.
template <int Order, class T>
ERGO_HD RayEnd<T> trace_taylor(ScalarOf<T> spin, const RayStart<T>& start, const MaskOf<RealOf<T>>& active_at_start,
                               const IntegrationSettings& settings, RealOf<T>& steps, MaskOf<RealOf<T>>& reached) {
  using S = ScalarOf<T>;
  using Real = RealOf<T>;
  const Real tolerance = local_tolerance(spin, start, settings);
  const Real polar_speed = safe_sqrt(maximum(value_of(start.polar_constant), Real(S(0)))) + S(1);
  // A straight ray has no higher terms that limit the step, so a step covers at most a few radians.
  const Real longest(S(3));
  const Real inverse_scale = S(1) / polar_speed;
  const TaylorCoefficients<T> coefficients = taylor_coefficients(spin, start, inverse_scale);
  RayState<T> state = initial_state(start);
  state.u_rate = state.u_rate * inverse_scale;
  state.m_rate = {state.m_rate.x * inverse_scale, state.m_rate.y * inverse_scale, state.m_rate.z * inverse_scale};
  T time(S(0));
  Real error(S(0));
  steps = Real(S(0));
  auto active = active_at_start;
  TaylorSeries<Order, T> series;
  for (int step = 0; step < settings.step_limit && any(active); ++step) {
    expand(spin, coefficients, state, series);
    const Real length = minimum(longest, detail::step_length(series, tolerance, polar_speed));
    Real u_at_end = value_of(series.u[Order]);
    ERGO_UNROLL
    for (int k = Order - 1; k >= 0; --k) {
      u_at_end = u_at_end * length + value_of(series.u[k]);
    }
    const auto last_step = active & (u_at_end <= Real(S(0)));
    T h(length);
    if (any(last_step)) {
      h = select(last_step, detail::time_to_infinity(series, length), h);
    }
    detail::assign_where<Real>(active, state, evaluate(series, h));
    time = select(active, time + h, time);
    // The first neglected terms are about as large as the last kept ones, at most the tolerance,
    // times the ratio of successive terms, for which 1/4 is assumed.
    error = select(active, error + tolerance * Real(S(0.25)), error);
    steps = select(active, steps + S(1), steps);
    active = active & (u_at_end > Real(S(0)));
  }
  const Vector3<T> sky = sky_direction(state);
  // Lanes whose sky direction is NaN count as not reached.
  reached = active_at_start & (!active) & (value_of(dot(sky, sky)) < Real(S(2)));
  return {sky, time * inverse_scale, T(error)};
}

}  // namespace ergodome::inline ERGO_TARGET
