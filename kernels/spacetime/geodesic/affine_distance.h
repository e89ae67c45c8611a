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
struct AffineSeries {
  double u[affine_order + 1];
  double r[affine_order + 1];
  double z[affine_order + 1];
  double distance[affine_order + 1];
};

//! Fills the series from coefficients 0 and 1 of u and z, and coefficient 0 of the distance:
//!   u'' = (a² E² - C) u + 3 K u² - 2 a² Q u³ ,   z'' = -(C - a² E²) z - 2 a² E² z³ .
ERGO_HD void expand_affine(double carter_c, double a2e2, double three_k, double a2q, double a2, AffineSeries& s) {
  double u2[affine_order + 1];
  double z2[affine_order + 1];
  double r2[affine_order + 1];
  for (int k = 0; k < affine_order; ++k) {
    double reciprocal = k == 0 ? 1.0 : 0.0;
    for (int i = 1; i <= k; ++i) {
      reciprocal -= s.u[i] * s.r[k - i];
    }
    s.r[k] = reciprocal / s.u[0];
    u2[k] = square_coefficient(s.u, k);
    z2[k] = square_coefficient(s.z, k);
    r2[k] = square_coefficient(s.r, k);
    s.distance[k + 1] = (r2[k] + a2 * z2[k]) / (k + 1);
    if (k + 2 <= affine_order) {
      const double share = 1.0 / ((k + 1) * (k + 2));
      const double u3 = product_coefficient(u2, s.u, k);
      const double z3 = product_coefficient(z2, s.z, k);
      s.u[k + 2] = share * ((a2e2 - carter_c) * s.u[k] + three_k * u2[k] - 2.0 * a2q * u3);
      s.z[k + 2] = share * ((a2e2 - carter_c) * s.z[k] - 2.0 * a2e2 * z3);
    }
  }
  s.r[affine_order] = 0.0;
}

//! Returns a step in which all series converge fast, from the size of their last terms (Jorba &
//! Zou).
ERGO_HD double affine_step_of(const AffineSeries& s) {
  double shortest = std::numeric_limits<double>::max();
  const auto limit = [&](double term, double size, int order) {
    if (::fabs(term) > 0.0) {
      shortest = ::fmin(shortest, ::pow(size / ::fabs(term), 1.0 / order));
    }
  };
  for (int order = affine_order - 2; order < affine_order; ++order) {
    limit(s.r[order], s.r[0], order);
    limit(s.u[order], s.u[0], order);
    limit(s.z[order], 1.0, order);
  }
  return affine_step * shortest;
}

}  // namespace detail

//! Returns the affine distance [M] from a camera to the radius `r_end` [M] in direction `n` (unit
//! vector in the observer's frame), backwards along the light. `r_end` is the radius of a shell, or
//! of the horizon, where the observer's past ends. The first crossing counts. Returns infinity if
//! the ray does not reach `r_end` within affine_step_limit steps.
ERGO_HD double affine_distance(const CameraStation& camera, const Vector3<double>& n, double r_end) {
  const double energy = detail::evaluate(camera.energy, n);
  const double momentum = detail::evaluate(camera.axial_momentum, n);
  const double polar = detail::evaluate(camera.polar_rate, n);
  const double azimuthal = detail::evaluate(camera.azimuthal_rate, n);
  const double a2 = camera.spin * camera.spin;
  const double a2e2 = a2 * energy * energy;
  const double c = polar * polar + azimuthal * azimuthal - a2e2 * camera.cosine_theta * camera.cosine_theta;
  const double k = c - 2.0 * camera.spin * energy * momentum + a2e2;
  const double a2q = a2 * (c - momentum * momentum);
  const double u_end = 1.0 / r_end;
  const double side = u_end >= camera.u ? 1.0 : -1.0;
  detail::AffineSeries s{};
  s.u[0] = camera.u;
  s.u[1] = -detail::evaluate(camera.outward_rate, n);
  s.z[0] = camera.cosine_theta;
  s.z[1] = -camera.sine_theta * polar;
  for (int step = 0; step < detail::affine_step_limit; ++step) {
    detail::expand_affine(c, a2e2, 3.0 * k, a2q, a2, s);
    double h = detail::affine_step_of(s);
    if (side * (series_value(s.u, h) - u_end) >= 0.0) {
      // u passes u_end within this step: refine h by Newton's method, safeguarded by bisection.
      double low = 0.0;
      for (int round = 0; round < 60 && h - low > 1e-15 * h; ++round) {
        const double newton = h - (series_value(s.u, h) - u_end) / series_rate(s.u, h);
        const double middle = newton > low && newton < h ? newton : 0.5 * (low + h);
        const bool passed = side * (series_value(s.u, middle) - u_end) >= 0.0;
        if (::fabs(middle - h) <= 1e-15 * h) {
          break;
        }
        (passed ? h : low) = middle;
      }
      return series_value(s.distance, h);
    }
    const double u = series_value(s.u, h);
    const double rate = series_rate(s.u, h);
    // The ray moves outwards, far away, with no barrier ahead: its light comes from the sky.
    if (u <= 0.0 || (rate < 0.0 && u < 1e-9 * camera.u)) {
      return std::numeric_limits<double>::infinity();
    }
    const double z = series_value(s.z, h);
    const double z_rate = series_rate(s.z, h);
    s.distance[0] = series_value(s.distance, h);
    s.u[0] = u;
    s.u[1] = rate;
    s.z[0] = z;
    s.z[1] = z_rate;
  }
  return std::numeric_limits<double>::infinity();
}

}  // namespace ergodome::inline ERGO_TARGET
