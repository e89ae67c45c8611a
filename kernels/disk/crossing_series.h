#pragma once

#include "kernels/disk/disk_ray.h"
#include "kernels/geodesic/taylor.h"

// Taylor series in Mino time of light that is followed to the equatorial plane, as in kernels/geodesic/taylor.h, which here carry the
// coordinate time too.
namespace ergodome::inline ERGO_TARGET {

//! A place in the equatorial plane where light comes from.
template <class T>
struct EquatorialCrossing {
  T u;       //!< 1 / r [1/M]; 0 where there is none. Without WithDelay also past infinity, u < 0, and past the horizon
  T u_rate;  //!< du/dλ, backwards: positive for light that was emitted outwards
  T x, y;    //!< (cosφ, sinφ) without frame dragging; with WithDelay alone
  T drag;    //!< φ is the angle of (x, y) and this [rad]; with WithDelay alone
  T delay;   //!< coordinate time from emission to the camera [M]; with WithDelay alone
};

namespace detail {

//! The series of a ray in scaled time; the last three with WithDelay alone.
template <int Order, class T, bool WithDelay>
struct CrossingSeries {
  T u[Order + 1];
  T z[Order + 1];
  T x[WithDelay ? Order + 1 : 1];
  T y[WithDelay ? Order + 1 : 1];
  T drag[WithDelay ? Order + 1 : 1];
  T delay[WithDelay ? Order + 1 : 1];
};

//! Constants of a ray as the recurrences use them, in time scaled by 1 / s.
template <class T>
struct CrossingCoefficients {
  T linear;       //!< (a² E² - C) / s², of u and of z
  T u_quadratic;  //!< 3 K / s²
  T u_cubic;      //!< -2 a² Q / s²
  T polar;        //!< C / s²
  T spring;       //!< a² E² / s²
  RealOf<T> inverse_scale;
};

//! Frame dragging and time, by division of series by Δ u² = (1 - r_+ u)(1 - (a²/r_+) u):
//!   ψ' = a (2 E u - a L u²) / Δu²,   t' = (1 + a²u²)(E (1 + a²u²) - a L u²) / (u² Δu²) + a (L - a E (1 - z²)).
template <int Order, class T>
ERGO_HD void expand_delay(ScalarOf<T> spin, const DiskRay<T>& ray, const RealOf<T>& inverse_scale, const T* square,
                          const T* z_square, CrossingSeries<Order, T, true>& s) {
  using S = ScalarOf<T>;
  const S a2 = spin * spin;
  const S horizon_r = S(1) + safe_sqrt((S(1) - spin) * (S(1) + spin));
  const T l = ray.axial_angular_momentum;
  const T skew = a2 * ray.energy - spin * l;
  T moment[Order];   // E (1 + a² u²) - a L u²
  T product[Order];  // the same times 1 + a² u²
  T radius[Order];   // r = 1/u
  T radius_square[Order];
  T lapse[Order];  // Δ u²
  T drag_rate[Order];
  T time_rate[Order];  // of the part with Δ
  const T inverse_u = S(1) / s.u[0];
  T inverse_lapse(S(1));
  ERGO_UNROLL
  for (int k = 0; k < Order; ++k) {
    moment[k] = skew * square[k];
    lapse[k] = a2 * square[k] - S(2) * s.u[k];
    T reciprocal(S(k == 0 ? 1 : 0));
    if (k == 0) {
      moment[0] = moment[0] + ray.energy;
      lapse[0] = (S(1) - horizon_r * s.u[0]) * (S(1) - (a2 / horizon_r) * s.u[0]);
      inverse_lapse = S(1) / lapse[0];
    }
    product[k] = moment[k] + a2 * product_coefficient(square, moment, k);
    T drag = (-spin) * (S(2) * (ray.energy * s.u[k]) - spin * (l * square[k]));
    ERGO_UNROLL
    for (int i = 1; i <= k; ++i) {
      reciprocal = reciprocal - s.u[i] * radius[k - i];
      drag = drag - lapse[i] * drag_rate[k - i];
    }
    radius[k] = reciprocal * inverse_u;
    radius_square[k] = square_coefficient(radius, k);
    drag_rate[k] = drag * inverse_lapse;
    T time = product_coefficient(product, radius_square, k);
    ERGO_UNROLL
    for (int i = 1; i <= k; ++i) {
      time = time - lapse[i] * time_rate[k - i];
    }
    time_rate[k] = time * inverse_lapse;
    T whole_rate = time_rate[k] + a2 * (ray.energy * z_square[k]);
    if (k == 0) {
      whole_rate = whole_rate + (spin * l - a2 * ray.energy);
    }
    const RealOf<T> share = inverse_scale * S(1.0 / (k + 1));
    s.drag[k + 1] = drag_rate[k] * share;
    s.delay[k + 1] = whole_rate * share;
  }
}

//! Fills the series from their coefficients 0 and, of the places, 1.
template <int Order, class T, bool WithDelay>
ERGO_HD void expand_crossing(ScalarOf<T> spin, const DiskRay<T>& ray, const CrossingCoefficients<T>& c,
                             CrossingSeries<Order, T, WithDelay>& s) {
  using S = ScalarOf<T>;
  T square[Order + 1];
  T z_square[Order + 1];
  T force[Order + 1];                 // u'' / u
  T spring[Order + 1];                // z'' / z
  T bend[WithDelay ? Order + 1 : 1];  // x'' / x
  ERGO_UNROLL
  for (int k = 0; k < Order; ++k) {
    square[k] = square_coefficient(s.u, k);
    z_square[k] = square_coefficient(s.z, k);
    if (k + 2 > Order) {
      continue;
    }
    force[k] = c.u_quadratic * s.u[k] + c.u_cubic * square[k];
    spring[k] = S(-2) * (c.spring * z_square[k]);
    if constexpr (WithDelay) {
      bend[k] = spring[k];
    }
    if (k == 0) {
      force[0] = force[0] + c.linear;
      spring[0] = spring[0] + c.linear;
      if constexpr (WithDelay) {
        bend[0] = bend[0] - c.polar;
      }
    }
    const S share = S(1.0 / ((k + 1) * (k + 2)));
    s.u[k + 2] = product_coefficient(force, s.u, k) * share;
    s.z[k + 2] = product_coefficient(spring, s.z, k) * share;
    if constexpr (WithDelay) {
      s.x[k + 2] = product_coefficient(bend, s.x, k) * share;
      s.y[k + 2] = product_coefficient(bend, s.y, k) * share;
    }
  }
  if constexpr (WithDelay) {
    expand_delay(spin, ray, c.inverse_scale, square, z_square, s);
  }
}

//! Size of the terms of power k; u and the delay count as angles and beside the radius.
template <int Order, class T, bool WithDelay>
ERGO_HD RealOf<T> crossing_term(const CrossingSeries<Order, T, WithDelay>& s, int k, const RealOf<T>& scale) {
  const auto size = [](const T& term) { return absolute(value_of(term)); };
  RealOf<T> sum = size(s.z[k]) + scale * size(s.u[k]);
  if constexpr (WithDelay) {
    sum = sum + size(s.x[k]) + size(s.y[k]) + size(s.drag[k]) + size(s.delay[k]) * absolute(value_of(s.u[0]));
  }
  return sum;
}

//! The h in [0, length] at which z changes its sign from that of `side`; exact in the dual parts too.
template <int Order, class T>
ERGO_HD T time_to_plane(const T (&z)[Order], const RealOf<T>& side, const RealOf<T>& length) {
  using Real = RealOf<T>;
  using S = ScalarOf<T>;
  Real plain[Order];
  ERGO_UNROLL
  for (int k = 0; k < Order; ++k) {
    plain[k] = value_of(z[k]);
  }
  Real low(S(0));
  Real high = length;
  const Real at_end = series_value(plain, length);
  Real h = length * (plain[0] / (plain[0] - at_end));
  constexpr int rounds = sizeof(S) == 4 ? 5 : 9;
  for (int round = 0; round < rounds; ++round) {
    const Real value = series_value(plain, h);
    const auto before = value * side > Real(S(0));
    low = select(before, h, low);
    high = select(before, high, h);
    const Real next = h - value / series_rate(plain, h);
    h = select((next >= low) & (next <= high), next, S(0.5) * (low + high));
  }
  return T(h) - series_value(z, T(h)) / series_rate(z, T(h));
}

//! Writes a crossing where the mask holds.
template <class Mask, class T>
ERGO_HD void keep_crossing(const Mask& mask, const EquatorialCrossing<T>& from, EquatorialCrossing<T>& to) {
  to = {select(mask, from.u, to.u), select(mask, from.u_rate, to.u_rate), select(mask, from.x, to.x),
        select(mask, from.y, to.y), select(mask, from.drag, to.drag),     select(mask, from.delay, to.delay)};
}

template <class T>
ERGO_HD CrossingCoefficients<T> crossing_coefficients(ScalarOf<T> spin, const DiskRay<T>& ray,
                                                      const RealOf<T>& inverse_scale) {
  using S = ScalarOf<T>;
  using Real = RealOf<T>;
  const S a2 = spin * spin;
  const Real square = inverse_scale * inverse_scale;
  const T a2e2 = a2 * (ray.energy * ray.energy);
  return {(a2e2 - ray.polar_constant) * square,
          ray.shear_constant * (S(3) * square),
          ray.carter * (S(-2) * a2 * square),
          ray.polar_constant * square,
          a2e2 * square,
          inverse_scale};
}

template <int Order, class T, bool WithDelay>
ERGO_HD void start_series(const DiskRay<T>& ray, const RealOf<T>& inverse_scale,
                          CrossingSeries<Order, T, WithDelay>& s) {
  const T zero(ScalarOf<T>(0));
  s.u[0] = ray.u;
  s.u[1] = ray.u_rate * inverse_scale;
  s.z[0] = ray.m.z;
  s.z[1] = ray.m_rate.z * inverse_scale;
  if constexpr (WithDelay) {
    s.x[0] = ray.m.x;
    s.x[1] = ray.m_rate.x * inverse_scale;
    s.y[0] = ray.m.y;
    s.y[1] = ray.m_rate.y * inverse_scale;
    s.drag[0] = zero;
    s.delay[0] = zero;
  }
}

//! Coefficients 0 and 1 of the series about h.
template <int Order, class T, bool WithDelay>
ERGO_HD void move_series(CrossingSeries<Order, T, WithDelay>& s, const RealOf<T>& h) {
  const auto move = [&h](auto& c) {
    const T value = series_value(c, h);
    c[1] = series_rate(c, h);
    c[0] = value;
  };
  move(s.u);
  move(s.z);
  if constexpr (WithDelay) {
    move(s.x);
    move(s.y);
    s.drag[0] = series_value(s.drag, h);
    s.delay[0] = series_value(s.delay, h);
  }
}

template <int Order, class T, bool WithDelay>
ERGO_HD EquatorialCrossing<T> crossing_at(const CrossingSeries<Order, T, WithDelay>& s, const T& h,
                                          const RealOf<T>& scale) {
  const T none(ScalarOf<T>(0));
  EquatorialCrossing<T> crossing = {series_value(s.u, h), series_rate(s.u, h) * scale, none, none, none, none};
  if constexpr (WithDelay) {
    crossing.x = series_value(s.x, h);
    crossing.y = series_value(s.y, h);
    crossing.drag = series_value(s.drag, h);
    crossing.delay = series_value(s.delay, h);
  }
  return crossing;
}

//! The sign of z, or another where it is 0.
template <class Real>
ERGO_HD Real side_of(const Real& z, const Real& otherwise) {
  using S = ScalarOf<Real>;
  return select(z > Real(S(0)), Real(S(1)), select(z < Real(S(0)), Real(S(-1)), otherwise));
}

//! Lanes whose light passes the horizon on the way to the end of a step, even if it turns behind it: what comes back is another universe's.
template <int Order, class T, bool WithDelay>
ERGO_HD MaskOf<RealOf<T>> falls_within(const CrossingSeries<Order, T, WithDelay>& s, const RealOf<T>& length,
                                       ScalarOf<T> horizon_r) {
  using S = ScalarOf<T>;
  using Real = RealOf<T>;
  const Real zero(S(0));
  Real u[Order + 1];
  ERGO_UNROLL
  for (int k = 0; k <= Order; ++k) {
    u[k] = value_of(s.u[k]);
  }
  Real highest = series_value(u, length);
  const auto turns = (u[1] > zero) & (series_rate(u, length) < zero);
  if (any(turns)) {
    Real low = zero;
    Real high = length;
    constexpr int rounds = 10;
    for (int round = 0; round < rounds; ++round) {
      const Real middle = S(0.5) * (low + high);
      const auto before = series_rate(u, middle) > zero;
      low = select(before, middle, low);
      high = select(before, high, middle);
    }
    highest = select(turns, series_value(u, low), highest);
  }
  return highest * horizon_r > Real(S(1));
}

//! How long a step may be: neglected terms stay below the tolerance, and the polar motion, which takes π or more of scaled time from
//! crossing to crossing, meets no two of them.
template <int Order, class T, bool WithDelay>
ERGO_HD RealOf<T> crossing_step(const CrossingSeries<Order, T, WithDelay>& s, const RealOf<T>& scale,
                                ScalarOf<T> tolerance) {
  using S = ScalarOf<T>;
  using Real = RealOf<T>;
  const Real tiny(std::numeric_limits<S>::min() * S(1e6));
  const Real last = crossing_term(s, Order, scale) + tiny;
  const Real next_to_last = crossing_term(s, Order - 1, scale) + tiny;
  return minimum(Real(S(3)), minimum(rough_power(Real(tolerance) / last, S(1.0 / Order)),
                                     rough_power(Real(tolerance) / next_to_last, S(1.0 / (Order - 1)))));
}

}  // namespace detail

}  // namespace ergodome::inline ERGO_TARGET
