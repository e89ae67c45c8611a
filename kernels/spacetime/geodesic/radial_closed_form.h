#pragma once

#include "kernels/spacetime/geodesic/carlson.h"
#include "kernels/spacetime/geodesic/radial_potential.h"
#include "kernels/spacetime/kerr/kerr.h"

// Radial motion in closed form: roots of the radial potential, Mino time and frame dragging.
namespace ergodome::inline ERGO_TARGET {

//! The four roots r_i of R(r) = r⁴ + (a² - C) r² + 2 K r - a² Q: U(u) = Π (1 - r_i u).
//!
//! R = (r² + 2 z r + A1)(r² - 2 z r + A2), where y = z² is the largest root of Ferrari's resolvent
//! 16 y³ + 8 (a² - C) y² + ((a² - C)² + 4 a² Q) y - K² = 0. It remains simple when two roots of R
//! coincide (the critical curve). The last two roots are those of the second factor: the turning
//! point 1 / r_4 and its companion. (Gralla & Lupsasca 2020, appendix B.)
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
  // From above all roots (Lagrange's bound) Newton's method falls monotonically to the largest
  // root. Where that is the only root and lies left of both extrema, or of the inflection, the
  // method would jump about if it started from above. There it starts from 0 and rises
  // monotonically.
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
  // For a camera near the photon orbits the discriminant is the square of a small number, lost in
  // rounding. The ray's u'² = U, which is known accurately, gives the second factor at the camera,
  // and from it the discriminant.
  const double r = 1.0 / ray.u;
  if (::fabs(r - z) < 0.5 * z) {
    const double rate = r * r * ray.u_rate;
    discriminant = (r - z) * (r - z) - rate * rate / ((r + 2.0 * z) * r + half_sum - ratio + y);
  }
  const Complex second = sqrt(Complex(discriminant));
  return {{Complex(-z) - first, Complex(-z) + first, Complex(z) - second, Complex(z) + second}};
}

//! ∫_0^x du / √U and ∫_0^x du / ((1 - ρ u) √U) for two poles ρ, with x at most the first root. If x
//! is beyond a pole, this is Cauchy's principal value: the real part of Carlson's forms above their
//! cut, where R_C(s², q²) is odd in s.
struct RadialIntegrals {
  double time;
  double pole[2];
};

//! Computes the integrals by Carlson's forms for a quartic that is a product of linear factors,
//! DLMF 19.29.4 and 19.29.8 with y = 0.
//!
//! `rate` is √U at x, which is more accurate than the roots. Next to a turning point 1 / r_4, and
//! at it (where the rate is 0), 1 - r_4 x is computed from the rate, not as a difference with
//! rounding.
ERGO_HD RadialIntegrals radial_integrals(const RadialRoots& roots, double x, double rate, const double (&rho)[2]) {
  if (!(x > 0.0)) {
    return {0.0, {0.0, 0.0}};
  }
  const Complex one(1.0);
  Complex square[4];
  for (int i = 0; i < 4; ++i) {
    square[i] = one - roots.r[i] * Complex(x);
    // Next to a turning point, rounding may leave a small negative number, which becomes 0.
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
  double drag;        //!< frame dragging ψ [rad], backwards
  double drag_error;  //!< error of `drag` [rad]: its parts nearly cancel for close horizons
};

namespace detail {

//! Radii of an outer and an inner horizon, the hole's or replacements, for the partial fractions of
//! the frame dragging; and the weight of their drag in the sum (see horizon_pairs()).
struct HorizonPair {
  double outer;
  double inner;
  double spin2;  //!< product of both radii [M²]
  double weight;
};

//! Pairs of horizons whose weighted drags add up to the hole's drag.
struct HorizonPairs {
  HorizonPair pair[4];
  int count;
};

//! Returns the hole's horizons, or four pairs that replace them. Partial fractions lose digits in
//! the ratio of the ray's distance from the horizons to the gap between them. Where the gap is too
//! small, the drag is extrapolated: a (2u - a L u²) / ((1 - u)² - x u²) is an analytic function of
//! x, the square of half the gap, and Lagrange's polynomial through four larger x gives its value
//! at the hole's x to 1e-14.
ERGO_HD HorizonPairs horizon_pairs(double spin, double largest_u) {
  const double a2 = spin * spin;
  const double half_gap = ::sqrt(::fmax(0.0, (1.0 - spin) * (1.0 + spin)));
  const double h = ::fmin(8e-3 * (1.0 - largest_u) / largest_u, 3e-3);
  if (h > 0.0 && half_gap < 4.0 * h) {
    HorizonPairs pairs{{}, 4};
    const double target = half_gap / h;
    for (int i = 0; i < 4; ++i) {
      const double own = i + 1.0;
      double weight = 1.0;
      for (int j = 0; j < 4; ++j) {
        const double other = j + 1.0;
        weight *= i == j ? 1.0 : (target * target - other * other) / (own * own - other * other);
      }
      pairs.pair[i] = {1.0 + own * h, 1.0 - own * h, (1.0 - own * h) * (1.0 + own * h), weight};
    }
    return pairs;
  }
  // For rays at or inside the horizon of an extremal hole, the gap between the horizons is kept
  // above a minimum.
  const double held = ::fmax(half_gap, 3e-6);
  const bool apart = held > half_gap;
  const double outer = 1.0 + held;
  const double inner = apart ? 1.0 - held : a2 / outer;
  return {{{outer, inner, apart ? outer * inner : a2, 1.0}}, 1};
}

//! A drag angle and the rounding error of its parts [rad].
struct Drag {
  double angle;
  double error;
};

//! Computes ∫_0^x a (2u - a L u²) / Δu² du / √U in partial fractions over the horizons. `time`
//! receives the Mino time.
ERGO_HD Drag drag_to(double spin, double l, const HorizonPairs& pairs, const RadialRoots& roots, double x, double rate,
                     double& time) {
  Drag drag{0.0, 0.0};
  for (int i = 0; i < pairs.count; ++i) {
    const HorizonPair& p = pairs.pair[i];
    const double rho[2] = {p.outer, p.inner};
    const RadialIntegrals integrals = radial_integrals(roots, x, rate, rho);
    time = integrals.time;
    if (spin == 0.0) {
      break;  // without spin there is no drag, and the inner pole of a radial ray coincides with its roots
    }
    // With inner = a²/outer, a (2 inner - a L) / (inner (inner - outer)) =
    // (2 a - L outer) / (inner - outer), which is accurate at a = 0.
    const double share = pairs.count > 1 || p.spin2 != spin * spin ? spin * spin / p.spin2 : 1.0;
    const double gap = p.outer - p.inner;
    const double at_outer = spin * (2.0 * p.outer - spin * l) / (p.outer * gap) * integrals.pole[0];
    const double at_inner = -(2.0 * spin - share * l * p.outer) / gap * integrals.pole[1];
    drag.angle += p.weight * (at_outer + at_inner - l * share * integrals.time);
    // Rounding error of about ten operations in each term.
    drag.error += 2e-15 * ::fabs(p.weight) * (::fabs(at_outer) + ::fabs(at_inner));
  }
  return drag;
}

//! Estimates the errors of a drag up to u other than the rounding of its parts [rad]. The camera's
//! position is rounded, which matters beside a horizon. The ray's constants are rounded, which the
//! drag amplifies by the third power of 1 / (1 - u) where the horizons are close. Horizons that are
//! closer than a minimum gap are moved apart, which changes the drag slightly.
ERGO_HD double drag_error_at(double spin, const HorizonPairs& pairs, double u) {
  if (spin == 0.0) {
    return 0.0;
  }
  const double half_gap = ::sqrt(::fmax(0.0, (1.0 - spin) * (1.0 + spin)));
  const double beside = ::fabs(1.0 - (1.0 + half_gap) * u);
  const double placed = beside < 0.01 ? 2e-16 / (beside * ::fmax(beside, 2.0 * half_gap) + 1e-300) : 0.0;
  const double to_horizon = ::fmax(::fmax(::fabs(1.0 - u), half_gap), 1e-4);
  const bool held = pairs.count == 1 && half_gap < 3e-6;
  return placed + (held ? 1e-11 : 4e-15) / (to_horizon * to_horizon * to_horizon);
}

}  // namespace detail

ERGO_HD RadialMotion radial_motion(double spin, const RayStart<double>& ray) {
  const RadialRoots roots = radial_roots(spin, ray);
  const double l = ray.axial_angular_momentum;
  const double r = 1.0 / ray.u;
  const bool within = !(r > horizon_radius(Spacetime{spin}));
  const bool turns = !within && ray.u_rate > 0.0;
  const double turn_u = 1.0 / roots.r[3].re;
  const detail::HorizonPairs pairs = detail::horizon_pairs(spin, within ? 1.0 : turns ? ::fmax(turn_u, ray.u) : ray.u);
  RadialMotion motion{};
  const detail::Drag to_camera = detail::drag_to(spin, l, pairs, roots, ray.u, ray.u_rate, motion.time);
  motion.drag_error = to_camera.error + detail::drag_error_at(spin, pairs, ray.u);
  if (!turns) {
    // Inside the horizon both terms are principal values; their divergence at the horizon cancels
    // in the azimuth of ingoing Kerr coordinates.
    motion.drag = -(to_camera.angle + (within ? ingoing_turn(Spacetime{spin}, r) : 0.0));
    return motion;
  }
  double turn_time = 0.0;
  const detail::Drag to_turn = detail::drag_to(spin, l, pairs, roots, turn_u, 0.0, turn_time);
  motion.time = 2.0 * turn_time - motion.time;
  motion.drag = -(2.0 * to_turn.angle - to_camera.angle);
  motion.drag_error += 2.0 * (to_turn.error + detail::drag_error_at(spin, pairs, turn_u));
  return motion;
}

}  // namespace ergodome::inline ERGO_TARGET
