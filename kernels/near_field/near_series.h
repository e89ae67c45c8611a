#pragma once

#include "kernels/geodesic/taylor.h"
#include "kernels/near_field/near_ray.h"

// Taylor series in Mino time of light that is followed to what stands near the hole, as in kernels/geodesic/taylor.h; here they carry the
// coordinate time too, and no more than is asked for.
namespace ergodome::inline ERGO_TARGET {

//! What is carried along a ray beside 1/r and the height m_z.
enum class NearParts {
  place_alone,
  distance,
  azimuth,
  azimuth_and_delay,
  azimuth_and_distance,
  azimuth_delay_and_distance
};

constexpr bool has_azimuth(NearParts parts) { return parts >= NearParts::azimuth; }
constexpr bool has_delay(NearParts parts) {
  return parts == NearParts::azimuth_and_delay || parts == NearParts::azimuth_delay_and_distance;
}
//! The affine distance of kernels/geodesic/affine_distance.h.
constexpr bool has_distance(NearParts parts) {
  return parts == NearParts::distance || parts == NearParts::azimuth_and_distance ||
         parts == NearParts::azimuth_delay_and_distance;
}

namespace detail {

//! The series of a ray in scaled time; which of them it carries is said by Parts.
template <int Order, class T, NearParts Parts>
struct NearSeries {
  T u[Order + 1];
  T z[Order + 1];
  T x[has_azimuth(Parts) ? Order + 1 : 1];
  T y[has_azimuth(Parts) ? Order + 1 : 1];
  T drag[has_azimuth(Parts) ? Order + 1 : 1];
  T delay[has_delay(Parts) ? Order + 1 : 1];
  T distance[has_distance(Parts) ? Order + 1 : 1];
};

//! Constants of a ray as the recurrences use them, in time scaled by 1 / s.
template <class T>
struct NearCoefficients {
  T linear;       //!< (a² E² - C) / s², of u and of z
  T u_quadratic;  //!< 3 K / s²
  T u_cubic;      //!< -2 a² Q / s²
  T polar;        //!< C / s²
  T spring;       //!< a² E² / s²
  RealOf<T> inverse_scale;
};

//! Frame dragging and, where it is carried, time, by division of series by Δ u² = (1 - r_+ u)(1 - (a²/r_+) u):
//!   ψ' = a (2 E u - a L u²) / Δu²,   t' = (1 + a²u²)(E (1 + a²u²) - a L u²) / (u² Δu²) + a (L - a E (1 - z²)).
template <int Order, NearParts Parts, class T>
ERGO_HD void expand_drag(ScalarOf<T> spin, const NearRay<T>& ray, const RealOf<T>& inverse_scale, const T* square,
                         const T* z_square, NearSeries<Order, T, Parts>& s) {
  using S = ScalarOf<T>;
  const S a2 = spin * spin;
  const S horizon_r = S(1) + safe_sqrt((S(1) - spin) * (S(1) + spin));
  const T l = ray.axial_angular_momentum;
  const T skew = a2 * ray.energy - spin * l;
  constexpr int time_terms = has_delay(Parts) ? Order : 1;
  T moment[time_terms];   // E (1 + a² u²) - a L u²
  T product[time_terms];  // the same times 1 + a² u²
  T radius[time_terms];   // r = 1/u
  T radius_square[time_terms];
  T lapse[Order];  // Δ u²
  T drag_rate[Order];
  T time_rate[time_terms];  // of the part with Δ
  const T inverse_u = S(1) / s.u[0];
  T inverse_lapse(S(1));
  ERGO_UNROLL
  for (int k = 0; k < Order; ++k) {
    const RealOf<T> share = inverse_scale * S(1.0 / (k + 1));
    lapse[k] = a2 * square[k] - S(2) * s.u[k];
    if (k == 0) {
      lapse[0] = (S(1) - horizon_r * s.u[0]) * (S(1) - (a2 / horizon_r) * s.u[0]);
      inverse_lapse = S(1) / lapse[0];
    }
    T drag = (-spin) * (S(2) * (ray.energy * s.u[k]) - spin * (l * square[k]));
    ERGO_UNROLL
    for (int i = 1; i <= k; ++i) {
      drag = drag - lapse[i] * drag_rate[k - i];
    }
    drag_rate[k] = drag * inverse_lapse;
    s.drag[k + 1] = drag_rate[k] * share;
    if constexpr (has_delay(Parts)) {
      moment[k] = skew * square[k];
      T reciprocal(S(k == 0 ? 1 : 0));
      if (k == 0) {
        moment[0] = moment[0] + ray.energy;
      }
      product[k] = moment[k] + a2 * product_coefficient(square, moment, k);
      ERGO_UNROLL
      for (int i = 1; i <= k; ++i) {
        reciprocal = reciprocal - s.u[i] * radius[k - i];
      }
      radius[k] = reciprocal * inverse_u;
      radius_square[k] = square_coefficient(radius, k);
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
      s.delay[k + 1] = whole_rate * share;
    }
  }
}

//! The affine distance: its rate is r² + a² z².
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

//! Fills the series from their coefficients 0 and, of the places, 1.
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
          inverse_scale};
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
    s.drag[0] = zero;
  }
  if constexpr (has_delay(Parts)) {
    s.delay[0] = zero;
  }
  if constexpr (has_distance(Parts)) {
    s.distance[0] = zero;
  }
}

//! The affine distance that a series has come to, where it carries that; else 0.
template <int Order, class T, NearParts Parts>
ERGO_HD T distance_so_far(const NearSeries<Order, T, Parts>& s) {
  if constexpr (has_distance(Parts)) {
    return s.distance[0];
  } else {
    return T(RealOf<T>(ScalarOf<T>(0)));
  }
}

//! Coefficients 0 and 1 of the series about h.
template <int Order, class T, NearParts Parts>
ERGO_HD void move_series(NearSeries<Order, T, Parts>& s, const RealOf<T>& h) {
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

}  // namespace detail

}  // namespace ergodome::inline ERGO_TARGET
