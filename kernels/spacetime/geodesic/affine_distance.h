#pragma once

#include <limits>

#include "kernels/spacetime/geodesic/taylor.h"
#include "kernels/spacetime/kerr/camera_station.h"

// Distance of light sources, as the observer would measure it in flat space when the light left. It
// is the affine parameter along the ray, in units in which the observer sees a photon energy of 1:
//   d = ∫ Σ dλ ,   Σ = r² + a² cos²θ ,
// with the Mino time λ of that photon. Nothing is divided by the energy at infinity, which may be 0
// or negative inside the ergosphere.
namespace ergodome::inline ERGO_TARGET {

namespace detail {

inline constexpr int affine_order = 14;
//! Step length as a fraction of the radius of convergence; the truncation error is about 0.2^14.
inline constexpr double affine_step = 0.2;
inline constexpr int affine_step_limit = 2000;

//! The series of u = 1/r, z = cosθ, and of the affine distance.
template <class T>
struct AffineSeries {
  T u[affine_order + 1];
  T r[affine_order + 1];
  T z[affine_order + 1];
  T distance[affine_order + 1];
};

//! Constants of a ray.
template <class T>
struct AffineConstants {
  T u_linear;     //!< a² E² - C
  T u_quadratic;  //!< 3 K
  T u_cubic;      //!< -2 a² Q
  T z_cubic;      //!< -2 a² E²
};

//! Fills the series from coefficients 0 and 1 of u and z, and coefficient 0 of the distance:
//!   u'' = (a² E² - C) u + 3 K u² - 2 a² Q u³ ,   z'' = -(C - a² E²) z - 2 a² E² z³ .
template <class T>
ERGO_HD void expand_affine(const AffineConstants<T>& c, double a2, AffineSeries<T>& s) {
  T u2[affine_order];
  T z2[affine_order];
  T r2[affine_order];
  const T inverse = 1.0 / s.u[0];
  s.r[0] = inverse;
  ERGO_UNROLL
  for (int k = 0; k < affine_order; ++k) {
    if (k > 0) {
      T sum = s.u[1] * s.r[k - 1];
      ERGO_UNROLL
      for (int i = 2; i <= k; ++i) {
        sum = sum + s.u[i] * s.r[k - i];
      }
      s.r[k] = -(sum * inverse);
    }
    u2[k] = square_coefficient(s.u, k);
    z2[k] = square_coefficient(s.z, k);
    r2[k] = square_coefficient(s.r, k);
    s.distance[k + 1] = (r2[k] + a2 * z2[k]) * (1.0 / (k + 1));
    if (k + 2 <= affine_order) {
      const double share = 1.0 / ((k + 1) * (k + 2));
      const T u3 = product_coefficient(u2, s.u, k);
      const T z3 = product_coefficient(z2, s.z, k);
      s.u[k + 2] = (c.u_linear * s.u[k] + c.u_quadratic * u2[k] + c.u_cubic * u3) * share;
      s.z[k + 2] = (c.u_linear * s.z[k] + c.z_cubic * z3) * share;
    }
  }
}

//! Returns a step in which all series converge fast, from the size of their last terms (Jorba &
//! Zou).
template <class T>
ERGO_HD T affine_step_of(const AffineSeries<T>& s) {
  constexpr double tiny = 1e-200;
  const auto reach = [&](int k) {
    const T of_r = s.r[0] / (absolute(s.r[k]) + tiny);
    const T of_u = s.u[0] / (absolute(s.u[k]) + tiny);
    const T of_z = 1.0 / (absolute(s.z[k]) + tiny);
    return rough_power(minimum(minimum(of_r, of_u), of_z), 1.0 / k);
  };
  return affine_step * minimum(reach(affine_order - 2), reach(affine_order - 1));
}

//! Returns the h in (0, within] at which u(h) = u_end, in lanes where u passes u_end on that way, by
//! Newton's method, safeguarded by bisection. `side` is 1 if u grows there, otherwise -1.
template <class T>
ERGO_HD T affine_arrival(const AffineSeries<T>& s, const T& within, double u_end, double side,
                         const MaskOf<T>& passing) {
  constexpr int rounds = 60;
  constexpr double precision = 1e-14;
  T low(0.0);
  T high = within;
  T h = within;
  MaskOf<T> open = passing;
  for (int round = 0; round < rounds && any(open); ++round) {
    const T beyond = series_value(s.u, h) - u_end;
    const auto passed = side * beyond >= T(0.0);
    high = select(passed, h, high);
    low = select(passed, low, h);
    const T newton = h - beyond / series_rate(s.u, h);
    const T next = select((newton >= low) & (newton <= high), newton, 0.5 * (low + high));
    const T move = absolute(next - h);
    h = select(open, next, h);
    open = open & (move > precision * h) & (high - low > precision * h);
  }
  return h;
}

}  // namespace detail

//! Returns the affine distances [M] from a camera to the radius `r_end` [M] in directions `n` (unit
//! vectors in the observer's frame), backwards along the light. `r_end` is the radius of a shell, or
//! of the horizon, where the observer's past ends. The first crossing counts. Returns infinity in
//! lanes whose rays do not reach `r_end` within affine_step_limit steps.
template <class T>
ERGO_HD T affine_distances(const CameraStation& camera, const Vector3<T>& n, double r_end) {
  const T zero(0.0);
  const T energy = detail::evaluate(camera.energy, n);
  const T momentum = detail::evaluate(camera.axial_momentum, n);
  const T polar = detail::evaluate(camera.polar_rate, n);
  const T azimuthal = detail::evaluate(camera.azimuthal_rate, n);
  const double a2 = camera.spin * camera.spin;
  const T a2e2 = a2 * energy * energy;
  const T carter_c = polar * polar + azimuthal * azimuthal - a2e2 * (camera.cosine_theta * camera.cosine_theta);
  const T shear = carter_c - 2.0 * camera.spin * energy * momentum + a2e2;
  const T a2q = a2 * (carter_c - momentum * momentum);
  const detail::AffineConstants<T> constants = {a2e2 - carter_c, 3.0 * shear, -2.0 * a2q, -2.0 * a2e2};
  const double u_end = 1.0 / r_end;
  const double side = u_end >= camera.u ? 1.0 : -1.0;
  detail::AffineSeries<T> s;
  s.u[0] = T(camera.u);
  s.u[1] = -detail::evaluate(camera.outward_rate, n);
  s.z[0] = T(camera.cosine_theta);
  s.z[1] = -camera.sine_theta * polar;
  s.distance[0] = zero;
  T distance(std::numeric_limits<double>::infinity());
  MaskOf<T> active = absolute(energy) < T(std::numeric_limits<double>::infinity());
  for (int step = 0; step < detail::affine_step_limit && any(active); ++step) {
    detail::expand_affine(constants, a2, s);
    const T length = detail::affine_step_of(s);
    const T u = series_value(s.u, length);
    const auto passing = active & (side * (u - u_end) >= zero);
    if (any(passing)) {
      const T h = detail::affine_arrival(s, length, u_end, side, passing);
      distance = select(passing, series_value(s.distance, h), distance);
    }
    const T rate = series_rate(s.u, length);
    // The ray moves outwards, far away, with no barrier ahead: its light comes from the sky.
    const auto lost = (u <= zero) | ((rate < zero) & (u < T(1e-9 * camera.u)));
    active = active & (!passing) & (!lost);
    const T z = series_value(s.z, length);
    const T z_rate = series_rate(s.z, length);
    s.distance[0] = select(active, series_value(s.distance, length), s.distance[0]);
    s.u[0] = select(active, u, s.u[0]);
    s.u[1] = select(active, rate, s.u[1]);
    s.z[0] = select(active, z, s.z[0]);
    s.z[1] = select(active, z_rate, s.z[1]);
  }
  return distance;
}

//! Returns the affine distance in one direction.
ERGO_HD double affine_distance(const CameraStation& camera, const Vector3<double>& n, double r_end) {
  return affine_distances(camera, n, r_end);
}

}  // namespace ergodome::inline ERGO_TARGET
