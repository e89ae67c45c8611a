#pragma once

#include "kernels/elliptic/carlson.h"
#include "kernels/geodesic/radial_potential.h"
#include "kernels/metric/kerr.h"

namespace ergodome::inline ERGO_TARGET {

//! The four roots r_i of R(r) = r⁴ + (a² - C) r² + 2 K r - a² Q: U(u) = Π (1 - r_i u).
//!
//! R = (r² + 2 z r + A1)(r² - 2 z r + A2), where y = z² is the largest root of Ferrari's resolvent
//! 16 y³ + 8 (a² - C) y² + ((a² - C)² + 4 a² Q) y - K² = 0. It stays simple when two roots of R meet (the critical curve). The last two
//! roots are those of the second factor: the turning point 1 / r_4 and its companion. (Gralla & Lupsasca 2020, appendix B.)
struct RadialRoots {
  Complex r[4];
};

ERGO_HD RadialRoots radial_roots(double spin, const RayStart<double>& ray) {
  const double a2 = spin * spin;
  const double alpha = a2 - ray.polar_constant;
  const double carter = ray.polar_constant - ray.axial_angular_momentum * ray.axial_angular_momentum;
  const double k = ray.shear_constant;
  const double linear = alpha * alpha + 4.0 * a2 * carter;
  const auto resolvent = [&](double y) { return ((16.0 * y + 8.0 * alpha) * y + linear) * y - k * k; };
  // From above all roots (Lagrange's bound) Newton's method falls monotonically onto the largest, and from 0 it rises monotonically onto
  // the only one where that lies to the left of both extrema, or of the inflection: from above it would leap about there.
  const double lowest = (safe_sqrt(alpha * alpha - 0.75 * linear) - alpha) / 6.0;
  const double rounding = 1e-12 * (k * k + ::fabs(linear) * lowest);
  const bool from_below = lowest > 0.0 && linear > 0.0 && resolvent(lowest) > rounding;
  double y = from_below ? 0.0 : ::fmax(::fabs(alpha), ::fmax(::sqrt(::fabs(linear)), ::cbrt(k * k)));
  for (int round = 0; round < 100; ++round) {
    const double next = y - resolvent(y) / ((48.0 * y + 16.0 * alpha) * y + linear);
    if (!(next > 0.0) || ::fabs(next - y) <= 1e-16 * y) {
      break;
    }
    y = next;
  }
  const double z = ::sqrt(y);
  const double half_sum = 0.5 * alpha + y;
  const double ratio = z > 0.0 ? 0.5 * k / z : 0.0;
  const Complex first = sqrt(Complex(ratio - half_sum));
  double discriminant = -ratio - half_sum;
  // For a camera near the photon orbits this is the square of a small number, lost in rounding; the ray's own u'² = U, which is
  // known well, tells the second factor at the camera, and through it the discriminant.
  const double r = 1.0 / ray.u;
  if (::fabs(r - z) < 0.5 * z) {
    const double rate = r * r * ray.u_rate;
    discriminant = (r - z) * (r - z) - rate * rate / ((r + 2.0 * z) * r + half_sum - ratio + y);
  }
  const Complex second = sqrt(Complex(discriminant));
  return {{Complex(-z) - first, Complex(-z) + first, Complex(z) - second, Complex(z) + second}};
}

//! ∫_0^x du / √U and ∫_0^x du / ((1 - ρ u) √U) for two poles ρ, x not beyond the first root; where x is beyond a pole, Cauchy's principal
//! value: the real part of what Carlson's forms are above their cut, where R_C(s², q²) is odd in s.
struct RadialIntegrals {
  double time;
  double pole[2];
};

//! Carlson's forms for a quartic that is a product of linear factors, DLMF 19.29.4 and 19.29.8 with y = 0.
//!
//! `rate` is √U at x, known better than the roots tell it: next to a turning point 1 / r_4, and at it (0), 1 - r_4 x follows from it and
//! is not the rounding of a difference.
ERGO_HD RadialIntegrals radial_integrals(const RadialRoots& roots, double x, double rate, const double (&rho)[2]) {
  if (!(x > 0.0)) {
    return {0.0, {0.0, 0.0}};
  }
  const Complex one(1.0);
  Complex square[4];
  for (int i = 0; i < 4; ++i) {
    square[i] = one - roots.r[i] * Complex(x);
    // Next to a turning point rounding may leave a small negative number.
    if (square[i].im == 0.0 && square[i].re < 0.0) {
      square[i].re = 0.0;
    }
  }
  const double others = (square[0] * square[1]).re * square[2].re;
  if (square[3].im == 0.0 && square[3].re < 1e-3 && others > 0.0) {
    square[3].re = rate * rate / others;
  }
  const Complex f[4] = {sqrt(square[0]), sqrt(square[1]), sqrt(square[2]), sqrt(square[3])};
  const Complex per_x(1.0 / x);
  const Complex u12 = (f[0] * f[1] + f[2] * f[3]) * per_x;
  const Complex u13 = (f[0] * f[2] + f[1] * f[3]) * per_x;
  const Complex u14 = (f[0] * f[3] + f[1] * f[2]) * per_x;
  RadialIntegrals result{};
  const Complex time = Complex(2.0) * carlson_rf(u12 * u12, u13 * u13, u14 * u14);
  result.time = time.re;
  const Complex d12 = roots.r[0] - roots.r[1];
  const Complex d13 = roots.r[0] - roots.r[2];
  const Complex d14 = roots.r[0] - roots.r[3];
  for (int i = 0; i < 2; ++i) {
    const Complex pole(rho[i]);
    const Complex d15 = roots.r[0] - pole;
    const Complex d25 = roots.r[1] - pole;
    const Complex u15_squared = u12 * u12 - d13 * d14 * d25 / d15;
    const Complex f5_squared = one - pole * Complex(x);
    const Complex s = (f[1] * f[2] * f[3] / f[0] + f5_squared) * per_x;
    const Complex q_squared = f5_squared * u15_squared / (f[0] * f[0]);
    const Complex with_factor =
        Complex(2.0 / 3.0) * d12 * d13 * d14 / d15 * carlson_rj(u12 * u12, u13 * u13, u14 * u14, u15_squared) +
        Complex(s.re < 0.0 ? -2.0 : 2.0) * carlson_rc(s * s, q_squared);
    // (1 - r_1 u) / (1 - ρ u) = r_1 / ρ + (1 - r_1 / ρ) / (1 - ρ u)
    const Complex integral = (pole * with_factor - roots.r[0] * time) / (pole - roots.r[0]);
    result.pole[i] = integral.re;
  }
  return result;
}

//! Mino time and frame dragging of a whole ray.
struct RadialMotion {
  double time;
  double drag;        //!< ψ, backwards [rad]
  double drag_error;  //!< what ψ may be off by: its two parts nearly cancel where the horizons are close [rad]
};

ERGO_HD RadialMotion radial_motion(double spin, const RayStart<double>& ray) {
  const RadialRoots roots = radial_roots(spin, ray);
  // a (2u - a L u²) / Δu² in partial fractions over the horizons; those of an extremal hole are held 6e-6 apart, which changes the
  // integrand by less than 1e-11 / (1 - u)⁴.
  const double half_gap = ::fmax(::sqrt(::fmax(0.0, (1.0 - spin) * (1.0 + spin))), 3e-6);
  const double outer = 1.0 + half_gap;
  const double inner = half_gap > 3e-6 ? spin * spin / outer : 1.0 - half_gap;
  const double l = ray.axial_angular_momentum;
  const double gap = outer - inner;
  const double product = outer * inner;
  // With inner = a²/outer: a (2 inner - a L) / (inner (inner - outer)) = (2 a - L outer) / (inner - outer), good at a = 0.
  const double at_outer = spin * (2.0 * outer - spin * l) / (outer * gap);
  const double share = half_gap > 3e-6 ? 1.0 : spin * spin / product;
  const double at_inner = -(2.0 * spin - share * l * outer) / gap;
  const double constant = -l * share;
  const double rho[2] = {outer, inner};
  const auto drag = [&](const RadialIntegrals& i) {
    // Without spin there is none, and the inner pole of a ray straight out is where its roots are.
    return spin == 0.0 ? 0.0 : constant * i.time + at_outer * i.pole[0] + at_inner * i.pole[1];
  };
  const auto drag_error = [&](const RadialIntegrals& i, double u) {
    // Rounding of the parts, some ten operations each; and the integral over 1/u of what holding the horizons apart changes.
    const double to_horizon = ::fmax(::fabs(1.0 - u), 1e-4);
    const double held = half_gap > 3e-6 ? 0.0 : 1e-11 / (to_horizon * to_horizon * to_horizon);
    // And of the camera's own place, where the drag changes as 1 over its distance from the horizon.
    const double beside = ::fabs(1.0 - outer * u);
    const double placed = beside < 0.01 ? 2e-16 / (gap * beside) : 0.0;
    return spin == 0.0 ? 0.0 : 2e-15 * (::fabs(at_outer * i.pole[0]) + ::fabs(at_inner * i.pole[1])) + held + placed;
  };
  const RadialIntegrals to_camera = radial_integrals(roots, ray.u, ray.u_rate, rho);
  const double r = 1.0 / ray.u;
  if (!(r > horizon_radius(spin))) {
    // Principal values of both: what diverges at the horizon on the way is the same in the azimuth of ingoing Kerr coordinates.
    return {to_camera.time, -(drag(to_camera) + ingoing_turn(spin, r)), drag_error(to_camera, ray.u)};
  }
  if (ray.u_rate <= 0.0) {
    return {to_camera.time, -drag(to_camera), drag_error(to_camera, ray.u)};
  }
  const RadialIntegrals to_turn = radial_integrals(roots, 1.0 / roots.r[3].re, 0.0, rho);
  return {2.0 * to_turn.time - to_camera.time, -(2.0 * drag(to_turn) - drag(to_camera)),
          2.0 * drag_error(to_turn, 1.0 / roots.r[3].re) + drag_error(to_camera, ray.u)};
}

}  // namespace ergodome::inline ERGO_TARGET
