#pragma once

#include "kernels/near_rays/near_azimuth.h"

// Taylor series in Mino time of light from the disk, shells and objects, as in
// kernels/spacetime/geodesic/taylor.h. Unlike there, NearParts selects what they carry, which may
// include coordinate time and affine distance.
namespace ergodome::inline ERGO_TARGET {

namespace detail {

//! Expands the affine distance, whose rate is r² + a² z².
template <int Order, NearParts Parts, class T>
ERGO_HD void expand_distance(ScalarOf<T> spin, const RealOf<T>& inverse_scale, const T* z_square,
                             NearSeries<Order, T, Parts>& s) {
  using S = ScalarOf<T>;
  const S a2 = spin * spin;
  T radius[Order];  // r = 1/u
  const T inverse_u = S(1) / s.u[0];
  ERGO_UNROLL
  for (int k = 0; k < Order; ++k) {
    T reciprocal(S(k == 0 ? 1 : 0));
    ERGO_UNROLL
    for (int i = 1; i <= k; ++i) {
      reciprocal = reciprocal - s.u[i] * radius[k - i];
    }
    radius[k] = reciprocal * inverse_u;
    const RealOf<T> share = inverse_scale * S(1.0 / (k + 1));
    s.distance[k + 1] = (square_coefficient(radius, k) + a2 * z_square[k]) * share;
  }
}

//! Expands the series from their coefficients 0 and, for 1/r and the polar position (x, y, z), 1.
template <int Order, class T, NearParts Parts>
ERGO_HD void expand_near(ScalarOf<T> spin, const NearRay<T>& ray, const NearCoefficients<T>& c,
                         NearSeries<Order, T, Parts>& s) {
  using S = ScalarOf<T>;
  T square[Order + 1];
  T z_square[Order + 1];
  T force[Order + 1];                          // u'' / u
  T spring[Order + 1];                         // z'' / z
  T bend[has_azimuth(Parts) ? Order + 1 : 1];  // x'' / x
  ERGO_UNROLL
  for (int k = 0; k < Order; ++k) {
    square[k] = square_coefficient(s.u, k);
    z_square[k] = square_coefficient(s.z, k);
    if (k + 2 > Order) {
      continue;
    }
    force[k] = c.u_quadratic * s.u[k] + c.u_cubic * square[k];
    spring[k] = S(-2) * (c.spring * z_square[k]);
    if constexpr (has_azimuth(Parts)) {
      bend[k] = spring[k];
    }
    if (k == 0) {
      force[0] = force[0] + c.linear;
      spring[0] = spring[0] + c.linear;
      if constexpr (has_azimuth(Parts)) {
        bend[0] = bend[0] - c.polar;
      }
    }
    const S share = S(1.0 / ((k + 1) * (k + 2)));
    s.u[k + 2] = product_coefficient(force, s.u, k) * share;
    s.z[k + 2] = product_coefficient(spring, s.z, k) * share;
    if constexpr (has_azimuth(Parts)) {
      s.x[k + 2] = product_coefficient(bend, s.x, k) * share;
      s.y[k + 2] = product_coefficient(bend, s.y, k) * share;
    }
  }
  if constexpr (has_azimuth(Parts)) {
    expand_drag(spin, ray, c.inverse_scale, square, z_square, s);
    if (any(c.ingoing)) {
      expand_ingoing(spin, ray, c.inverse_scale, c.ingoing, square, z_square, s);
    }
  }
  if constexpr (has_distance(Parts)) {
    expand_distance(spin, c.inverse_scale, z_square, s);
  }
}

template <class T>
ERGO_HD NearCoefficients<T> near_coefficients(ScalarOf<T> spin, const NearRay<T>& ray, const RealOf<T>& inverse_scale) {
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
          inverse_scale,
          counts_ingoing(ray)};
}

template <int Order, class T, NearParts Parts>
ERGO_HD void start_series(const NearRay<T>& ray, const RealOf<T>& inverse_scale, NearSeries<Order, T, Parts>& s) {
  const T zero(ScalarOf<T>(0));
  s.u[0] = ray.u;
  s.u[1] = ray.u_rate * inverse_scale;
  s.z[0] = ray.m.z;
  s.z[1] = ray.m_rate.z * inverse_scale;
  if constexpr (has_azimuth(Parts)) {
    s.x[0] = ray.m.x;
    s.x[1] = ray.m_rate.x * inverse_scale;
    s.y[0] = ray.m.y;
    s.y[1] = ray.m_rate.y * inverse_scale;
    s.drag[0] = select(counts_ingoing(ray), T(RealOf<T>(ray.turn)), zero);
  }
  if constexpr (has_delay(Parts)) {
    s.delay[0] = select(counts_ingoing(ray), T(RealOf<T>(ray.lag)), zero);
  }
  if constexpr (has_distance(Parts)) {
    s.distance[0] = zero;
  }
}

//! Returns the affine distance at the start of the series if they carry it, else 0.
template <int Order, class T, NearParts Parts>
ERGO_HD T distance_so_far(const NearSeries<Order, T, Parts>& s) {
  if constexpr (has_distance(Parts)) {
    return s.distance[0];
  } else {
    return T(RealOf<T>(ScalarOf<T>(0)));
  }
}

//! Moves the beginning of the series to h: replaces coefficient 0, and for 1/r and the polar
//! position also 1, by those about h. H is T or its type without derivatives.
template <int Order, class T, NearParts Parts, class H>
ERGO_HD void move_series(NearSeries<Order, T, Parts>& s, const H& h) {
  const auto move = [&h](auto& c) {
    const T value = series_value(c, h);
    c[1] = series_rate(c, h);
    c[0] = value;
  };
  move(s.u);
  move(s.z);
  if constexpr (has_azimuth(Parts)) {
    move(s.x);
    move(s.y);
    s.drag[0] = series_value(s.drag, h);
  }
  if constexpr (has_delay(Parts)) {
    s.delay[0] = series_value(s.delay, h);
  }
  if constexpr (has_distance(Parts)) {
    s.distance[0] = series_value(s.distance, h);
  }
}

//! Converts azimuth and time of the lanes of a mask from ingoing Kerr to Boyer-Lindquist
//! coordinates. These lanes have to be outside the horizon.
template <int Order, NearParts Parts, class T>
ERGO_HD void count_on_outside(ScalarOf<T> spin, const MaskOf<RealOf<T>>& lanes, NearSeries<Order, T, Parts>& s) {
  const RealOf<T> unscaled(ScalarOf<T>(1));
  const SeriesReading<T> reading = {spin, lanes, unscaled};
  if constexpr (has_delay(Parts)) {
    reading.count_outside(s.u[0], s.drag[0], s.delay[0]);
  } else {
    T none(RealOf<T>(ScalarOf<T>(0)));
    reading.count_outside(s.u[0], s.drag[0], none);
  }
}

}  // namespace detail

}  // namespace ergodome::inline ERGO_TARGET
