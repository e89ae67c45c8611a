#pragma once

#include <cmath>

#include "kernels/core/host_device.h"

// Kerr spacetime in Boyer-Lindquist coordinates, G = c = M = 1, signature (-,+,+,+):
//   Σ = r² + a² cos²θ,  Δ = r² - 2r + a²,  A = (r² + a²)² - a² Δ sin²θ.
// Radii of Bardeen, Press & Teukolsky, ApJ 178 (1972) 347; the spin a is in [-1, 1] and positive along +z.
namespace ergodome::inline ERGO_TARGET {

//! Radius of the outer event horizon [M]: 1 + √(1 - a²).
ERGO_HD double horizon_radius(double spin) { return 1.0 + ::sqrt(::fmax(0.0, (1.0 - spin) * (1.0 + spin))); }

//! Radius of the inner horizon [M]: 1 - √(1 - a²), 0 without spin.
ERGO_HD double inner_horizon_radius(double spin) { return spin * spin / horizon_radius(spin); }

//! How deep cameras may be within the horizon [M]: at the inner one all light of the outside's future comes at once, and without spin there
//! is the singularity in its place. The horizon itself where the spin is 1.
ERGO_HD double least_interior_radius(double spin) {
  const double inner = inner_horizon_radius(spin);
  return inner + 0.02 * (horizon_radius(spin) - inner);
}

//! What is between the azimuth of ingoing Kerr coordinates and Boyer-Lindquist's, which are one far away: ∫ a dr / Δ from infinity to r [rad].
//! On both sides of the horizon, at which it has no end; without end at the horizon of an extremal hole as well.
ERGO_HD double ingoing_turn(double spin, double r) {
  const double outer = horizon_radius(spin);
  const double inner = inner_horizon_radius(spin);
  const double gap = outer - inner;
  if (spin == 0.0) {
    return 0.0;
  }
  if (!(gap > 0.0)) {
    return -spin / (r - outer);
  }
  // ln|(r - r_+) / (r - r_-)|: far away, or where the horizons are close, without the cancellation of its fraction from 1.
  const double ratio = gap / (r - inner);
  return spin / gap * (ratio < 0.5 ? ::log1p(-ratio) : ::log(::fabs((r - outer) / (r - inner))));
}

//! By how much Boyer-Lindquist's time is ahead, at r > r_+, of that of who falls in, which is one with it far away and goes on through the horizon
//! [M]: 2 r_+ W, W = ln((r - r_-) / (r - r_+)) / (r_+ - r_-). Without end at the horizon itself.
ERGO_HD double ingoing_lag(double spin, double r) {
  const double outer = horizon_radius(spin);
  const double inner = inner_horizon_radius(spin);
  const double gap = outer - inner;
  // Where the horizons are close, without the cancellation of the fraction from 1.
  const double part = gap / (r - outer);
  return 2.0 * outer * (part > 1e-12 ? ::log1p(part) / gap : 1.0 / (r - outer));
}

//! The same, and 0 within the horizon, from where light is late by the time of who falls in.
ERGO_HD double outer_lag(double spin, double r) { return r > horizon_radius(spin) ? ingoing_lag(spin, r) : 0.0; }

//! Radius below which nothing can stand still against the stars [M]: the outer edge of the ergosphere at polar angle θ.
ERGO_HD double static_limit_radius(double spin, double theta) {
  const double a_cosine = spin * ::cos(theta);
  return 1.0 + ::sqrt(::fmax(0.0, 1.0 - a_cosine * a_cosine));
}

//! Radius of the circular equatorial photon orbit [M] that runs in the sense of `orbit_sign` (+1: along +φ; -1: against it).
//! Bardeen, Press & Teukolsky (1972), eq. 2.18.
ERGO_HD double photon_orbit_radius(double spin, double orbit_sign) {
  return 2.0 * (1.0 + ::cos(2.0 / 3.0 * ::acos(-orbit_sign * spin)));
}

//! Whether a camera is within the horizon or so near to it that 1 / Δ, in float, would be felt in Boyer-Lindquist's azimuth.
ERGO_HD bool is_near_horizon(double spin, double r) { return r <= 1.2 * horizon_radius(spin); }

//! Radius of the innermost stable circular orbit [M] in the sense of `orbit_sign`. Bardeen, Press & Teukolsky (1972), eq. 2.21.
ERGO_HD double innermost_stable_radius(double spin, double orbit_sign) {
  const double a = orbit_sign * spin;
  const double z1 = 1.0 + ::cbrt((1.0 - a) * (1.0 + a)) * (::cbrt(1.0 + a) + ::cbrt(1.0 - a));
  const double z2 = ::sqrt(3.0 * a * a + z1 * z1);
  const double sign = a >= 0.0 ? 1.0 : -1.0;
  return 3.0 + z2 - sign * ::sqrt((3.0 - z1) * (3.0 + z1 + 2.0 * z2));
}

//! The metric functions at one place.
struct KerrFunctions {
  double sigma;                 //!< Σ [M²]
  double delta;                 //!< Δ [M²]
  double area;                  //!< A [M⁴]
  double frame_dragging;        //!< ω = 2 a r / A, angular velocity of the zero-angular-momentum observer [1/M]
  double rain_speed;            //!< speed of free fall from rest at infinity in the ZAMO frame; 1 at the horizon
  double circumference_factor;  //!< √(A / Σ) [M]: the proper radius of the circle of latitude over sinθ
};

//! Evaluates the metric functions at (r, θ) [M, rad]; r > 0. Good on the axis, at the horizon and inside.
ERGO_HD KerrFunctions kerr_functions(double spin, double r, double theta) {
  const double a2 = spin * spin;
  const double cosine = ::cos(theta);
  const double sine = ::sin(theta);
  KerrFunctions f{};
  f.sigma = r * r + a2 * cosine * cosine;
  // By its roots: above the horizon of an extremal hole the sum of its terms has no digits left.
  const double horizon = horizon_radius(spin);
  f.delta = (r - horizon) * (r - a2 / horizon);
  f.area = (r * r + a2) * (r * r + a2) - a2 * f.delta * sine * sine;
  f.frame_dragging = 2.0 * spin * r / f.area;
  // 1 - ΣΔ/A without its cancellation: A - ΣΔ = 2r (r² + a²).
  f.rain_speed = ::sqrt(2.0 * r * (r * r + a2) / f.area);
  f.circumference_factor = ::sqrt(f.area / f.sigma);
  return f;
}

}  // namespace ergodome::inline ERGO_TARGET
