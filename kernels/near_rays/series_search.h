#pragma once

#include "kernels/near_rays/near_series.h"

// Steps along a ray's series, and the times of events within them.
namespace ergodome::inline ERGO_TARGET {

//! Limits for following rays through the near field: the precision and the number of their steps.
template <class S>
struct NearLimits {
  S tolerance;  //!< maximum local error of a step, as an angle [rad]
  int step_limit;
};

namespace detail {

//! Returns the h in [from, to] at which a series passes through zero, coming from the sign of
//! `side`. The series must do so exactly once. Derivatives of dual numbers are exact, too.
template <int Order, class T>
ERGO_HD T time_to_zero(const T (&c)[Order], const RealOf<T>& side, const RealOf<T>& from, const RealOf<T>& to) {
  using Real = RealOf<T>;
  using S = ScalarOf<T>;
  Real plain[Order];
  ERGO_UNROLL
  for (int k = 0; k < Order; ++k) {
    plain[k] = value_of(c[k]);
  }
  Real low = from;
  Real high = to;
  const Real at_start = series_value(plain, from);
  const Real secant = from + (to - from) * (at_start / (at_start - series_value(plain, to)));
  Real h = select((secant >= from) & (secant <= to), secant, S(0.5) * (from + to));
  constexpr int rounds = sizeof(S) == 4 ? 5 : 9;
  for (int round = 0; round < rounds; ++round) {
    const Real value = series_value(plain, h);
    const auto before = value * side > Real(S(0));
    low = select(before, h, low);
    high = select(before, high, h);
    const Real next = h - value / series_rate(plain, h);
    h = select((next >= low) & (next <= high), next, S(0.5) * (low + high));
  }
  return T(h) - series_value(c, T(h)) / series_rate(c, T(h));
}

//! Returns the size of the terms of power k as an angle: delay and distance are divided by the
//! radius, and 1/r counts through the shift of Mino time that it causes (`scale`: time of the
//! series / Mino time).
template <int Order, class T, NearParts Parts>
ERGO_HD RealOf<T> near_term(const NearSeries<Order, T, Parts>& s, int k, const RealOf<T>& scale) {
  const auto size = [](const T& term) { return absolute(value_of(term)); };
  RealOf<T> sum = size(s.z[k]) + scale * size(s.u[k]);
  if constexpr (has_azimuth(Parts)) {
    sum = sum + size(s.x[k]) + size(s.y[k]) + size(s.drag[k]);
  }
  if constexpr (has_delay(Parts)) {
    sum = sum + size(s.delay[k]) * absolute(value_of(s.u[0]));
  }
  if constexpr (has_distance(Parts)) {
    sum = sum + size(s.distance[k]) * absolute(value_of(s.u[0]));
  }
  return sum;
}

//! Returns the length of a step. Neglected terms stay below the tolerance, and the step contains at
//! most one crossing of the equatorial plane, since crossings are π or more of scaled time apart.
template <int Order, class T, NearParts Parts>
ERGO_HD RealOf<T> near_step(const NearSeries<Order, T, Parts>& s, const RealOf<T>& scale, ScalarOf<T> tolerance) {
  using S = ScalarOf<T>;
  using Real = RealOf<T>;
  const Real tiny(std::numeric_limits<S>::min() * S(1e6));
  const Real last = near_term(s, Order, scale) + tiny;
  const Real next_to_last = near_term(s, Order - 1, scale) + tiny;
  return minimum(Real(S(3)), minimum(rough_power(Real(tolerance) / last, S(1.0 / Order)),
                                     rough_power(Real(tolerance) / next_to_last, S(1.0 / (Order - 1)))));
}

}  // namespace detail

}  // namespace ergodome::inline ERGO_TARGET
