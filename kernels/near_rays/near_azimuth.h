#pragma once

#include "kernels/near_rays/near_parts.h"
#include "kernels/spacetime/kerr/horizon_winding.h"

// Azimuth and coordinate time along a ray's series.
namespace ergodome::inline ERGO_TARGET {

//! Parameters for reading positions from a ray's series.
template <class T>
struct SeriesReading {
  ScalarOf<T> spin;
  MaskOf<RealOf<T>> ingoing;  //!< lanes whose azimuth and time are in ingoing Kerr coordinates
  RealOf<T> scale;            //!< time of the series / Mino time

  //! Converts azimuth and time at 1/r = u outside the horizon to Boyer-Lindquist coordinates in all
  //! lanes.
  ERGO_HD void count_outside(const T& u, T& drag, T& delay) const {
    if (any(ingoing)) {
      const HorizonWinding<ScalarOf<T>> horizon = horizon_winding(spin, true);
      const T wound = winding(horizon, u);
      drag = select(ingoing, drag + winding_turn(horizon) * wound, drag);
      delay = select(ingoing, delay + winding_delay(horizon) * wound, delay);
    }
  }
};

namespace detail {

//! Expands the azimuth ψ of frame dragging and, if carried, the delay t, by division of series (z =
//! cosθ; rates are in Mino time, backwards):
//!   Δ u² = (1 - r_+ u)(1 - (a²/r_+) u),
//!   ψ' = -a (2 E u - a L u²) / Δu²,
//!   t' = (1 + a²u²)(E (1 + a²u²) - a L u²) / (u² Δu²) + a (L - a E (1 - z²)).
template <int Order, NearParts Parts, class T>
ERGO_HD void expand_drag(ScalarOf<T> spin, const NearRay<T>& ray, const RealOf<T>& inverse_scale, const T* square,
                         const T* z_square, NearSeries<Order, T, Parts>& s) {
  using S = ScalarOf<T>;
  const S a2 = spin * spin;
  const S horizon_r = kerr_horizon_radius(spin);
  const T l = ray.axial_angular_momentum;
  const T skew = a2 * ray.energy - spin * l;
  constexpr int time_terms = has_delay(Parts) ? Order : 1;
  T moment[time_terms];   // E (1 + a² u²) - a L u²
  T product[time_terms];  // `moment` times 1 + a² u²
  T radius[time_terms];   // r = 1/u
  T radius_square[time_terms];
  T lapse[Order];  // Δ u²
  T drag_rate[Order];
  T time_rate[time_terms];  // rate of the term of t' that is divided by Δ
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

//! Expands ψ and t in ingoing Kerr coordinates, in the lanes of a mask, for light that only comes
//! in to the camera.
//!
//! With X = E (r² + a²) - a L, and √R = -u'/u² for such light, X - √R = Δ K / (X + √R) cancels Δ in
//! the rates of φ + ∫ a dr/Δ and of t - 2 r_+ W (horizon_winding.h), counted backwards:
//!   ψ' = a E - a K u²/P,
//!   t' = (1 + a²u²) K/P - u' r² (1 + r_+ u) / (1 - r_- u) + a (L - a E (1 - z²)),
//!   P = E + (a² E - a L) u² - u',
//! and P > 0 all the way from within the horizon out to where light turns.
template <int Order, NearParts Parts, class T>
ERGO_HD void expand_ingoing(ScalarOf<T> spin, const NearRay<T>& ray, const RealOf<T>& inverse_scale,
                            const MaskOf<RealOf<T>>& lanes, const T* square, const T* z_square,
                            NearSeries<Order, T, Parts>& s) {
  using S = ScalarOf<T>;
  const S a2 = spin * spin;
  const S horizon_r = kerr_horizon_radius(spin);
  const S inner_r = a2 / horizon_r;
  const T shear = ray.shear_constant;
  const T skew = a2 * ray.energy - spin * ray.axial_angular_momentum;
  const RealOf<T> per_scale = S(1) / inverse_scale;
  constexpr int time_terms = has_delay(Parts) ? Order : 1;
  T fall[Order];          // -u'
  T sum[Order];           // P
  T part[Order];          // u² / P
  T inverse[time_terms];  // 1 / P
  T radius[time_terms];   // r = 1/u
  T radius_square[time_terms];
  T outward[time_terms];  // -u' (1 + r_+ u)
  T way[time_terms];      // -u' r² (1 + r_+ u) / (1 - r_- u)
  T inverse_sum(S(1));
  ERGO_UNROLL
  for (int k = 0; k < Order; ++k) {
    const RealOf<T> share = inverse_scale * S(1.0 / (k + 1));
    fall[k] = s.u[k + 1] * (per_scale * S(-(k + 1)));
    sum[k] = skew * square[k] + fall[k];
    if (k == 0) {
      sum[0] = sum[0] + ray.energy;
      inverse_sum = S(1) / sum[0];
    }
    const auto divided = [&](T rest, const T* quotient) {
      ERGO_UNROLL
      for (int i = 1; i <= k; ++i) {
        rest = rest - sum[i] * quotient[k - i];
      }
      return rest * inverse_sum;
    };
    part[k] = divided(square[k], part);
    T drag = (-spin) * (shear * part[k]);
    if (k == 0) {
      drag = drag + spin * ray.energy;
    }
    s.drag[k + 1] = select(lanes, drag * share, s.drag[k + 1]);
    if constexpr (has_delay(Parts)) {
      inverse[k] = divided(T(RealOf<T>(S(k == 0 ? 1 : 0))), inverse);
      T reciprocal(S(k == 0 ? 1 : 0));
      ERGO_UNROLL
      for (int i = 1; i <= k; ++i) {
        reciprocal = reciprocal - s.u[i] * radius[k - i];
      }
      radius[k] = reciprocal * (S(1) / s.u[0]);
      radius_square[k] = square_coefficient(radius, k);
      outward[k] = fall[k] + horizon_r * product_coefficient(s.u, fall, k);
      T rest = product_coefficient(outward, radius_square, k);
      ERGO_UNROLL
      for (int i = 1; i <= k; ++i) {
        rest = rest + (inner_r * s.u[i]) * way[k - i];
      }
      way[k] = rest / (S(1) - inner_r * s.u[0]);
      T rate = shear * (inverse[k] + a2 * part[k]) + way[k] + a2 * (ray.energy * z_square[k]);
      if (k == 0) {
        rate = rate + (spin * ray.axial_angular_momentum - a2 * ray.energy);
      }
      s.delay[k + 1] = select(lanes, rate * share, s.delay[k + 1]);
    }
  }
}

}  // namespace detail

}  // namespace ergodome::inline ERGO_TARGET
