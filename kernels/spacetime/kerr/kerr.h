#pragma once

#include <cmath>

#include "kernels/core/host_device.h"

// Kerr spacetime in Boyer-Lindquist coordinates, G = c = M = 1, signature (-,+,+,+):
//   Σ = r² + a² cos²θ,  Δ = r² - 2r + a²,  A = (r² + a²)² - a² Δ sin²θ.
// Radii of Bardeen, Press & Teukolsky, ApJ 178 (1972) 347. The spin a is in [-1, 1] and positive
// along +z.
namespace ergodome::inline ERGO_TARGET {

//! Returns the radius of the outer event horizon [M]: 1 + √(1 - a²).
ERGO_HD double horizon_radius(double spin) { return 1.0 + ::sqrt(::fmax(0.0, (1.0 - spin) * (1.0 + spin))); }

//! Returns the radius of the inner horizon [M]: 1 - √(1 - a²); 0 without spin.
ERGO_HD double inner_horizon_radius(double spin) { return spin * spin / horizon_radius(spin); }

//! Returns the smallest radius that cameras may have inside the horizon [M]: 2 % of the gap above
//! the inner horizon. At the inner horizon all light of the exterior's future arrives at once;
//! without spin the singularity is there instead. At spin 1 this is the horizon radius.
ERGO_HD double least_interior_radius(double spin) {
  const double inner = inner_horizon_radius(spin);
  return inner + 0.02 * (horizon_radius(spin) - inner);
}

//! Returns the azimuth of ingoing Kerr coordinates minus the Boyer-Lindquist azimuth [rad]: ∫ a dr
//! / Δ from infinity to r. The two agree far away. Finite on both sides of the horizon, infinite at
//! it; the same holds for an extremal hole.
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
  // ln|(r - r_+) / (r - r_-)|; log1p avoids cancellation far away and for close horizons.
  const double ratio = gap / (r - inner);
  return spin / gap * (ratio < 0.5 ? ::log1p(-ratio) : ::log(::fabs((r - outer) / (r - inner))));
}

//! Returns Boyer-Lindquist time minus infalling time at r > r_+ [M]: 2 r_+ W with W = ln((r - r_-)
//! / (r - r_+)) / (r_+ - r_-). Infalling time agrees with Boyer-Lindquist time far away and is
//! regular at the horizon. The difference is infinite at the horizon itself.
ERGO_HD double ingoing_lag(double spin, double r) {
  const double outer = horizon_radius(spin);
  const double inner = inner_horizon_radius(spin);
  const double gap = outer - inner;
  // log1p avoids cancellation where the horizons are close.
  const double part = gap / (r - outer);
  return 2.0 * outer * (part > 1e-12 ? ::log1p(part) / gap : 1.0 / (r - outer));
}

//! Returns ingoing_lag() outside the horizon, and 0 inside, where light delays are in infalling
//! time.
ERGO_HD double outer_lag(double spin, double r) { return r > horizon_radius(spin) ? ingoing_lag(spin, r) : 0.0; }

//! Returns the outer radius of the ergosphere at polar angle θ [M]. Below it, nothing can be at
//! rest relative to the stars.
ERGO_HD double static_limit_radius(double spin, double theta) {
  const double a_cosine = spin * ::cos(theta);
  return 1.0 + ::sqrt(::fmax(0.0, 1.0 - a_cosine * a_cosine));
}

//! Returns the radius of the circular equatorial photon orbit [M] in the sense of `orbit_sign` (+1:
//! along +φ; -1: against it). Bardeen, Press & Teukolsky (1972), eq. 2.18.
ERGO_HD double photon_orbit_radius(double spin, double orbit_sign) {
  return 2.0 * (1.0 + ::cos(2.0 / 3.0 * ::acos(-orbit_sign * spin)));
}

//! Returns whether a camera is inside the horizon or so close to it that, in float, 1 / Δ would
//! spoil the Boyer-Lindquist azimuth.
ERGO_HD bool is_near_horizon(double spin, double r) { return r <= 1.2 * horizon_radius(spin); }

//! Returns the radius of the innermost stable circular orbit [M] in the sense of `orbit_sign`.
//! Bardeen, Press & Teukolsky (1972), eq. 2.21.
ERGO_HD double innermost_stable_radius(double spin, double orbit_sign) {
  const double a = orbit_sign * spin;
  const double z1 = 1.0 + ::cbrt((1.0 - a) * (1.0 + a)) * (::cbrt(1.0 + a) + ::cbrt(1.0 - a));
  const double z2 = ::sqrt(3.0 * a * a + z1 * z1);
  const double sign = a >= 0.0 ? 1.0 : -1.0;
  return 3.0 + z2 - sign * ::sqrt((3.0 - z1) * (3.0 + z1 + 2.0 * z2));
}

//! The metric functions at one position.
struct KerrFunctions {
  double sigma;                 //!< Σ [M²]
  double delta;                 //!< Δ [M²]
  double area;                  //!< A [M⁴]
  double frame_dragging;        //!< ω = 2 a r / A, angular velocity of the ZAMO [1/M]
  double rain_speed;            //!< of free fall from rest at infinity, in the ZAMO frame
  double circumference_factor;  //!< √(A / Σ) [M]: proper radius of the circle of latitude / sinθ
};

//! Evaluates the metric functions at (r, θ) [M, rad], r > 0. Also accurate on the axis, at the
//! horizon and inside it.
ERGO_HD KerrFunctions kerr_functions(double spin, double r, double theta) {
  const double a2 = spin * spin;
  const double cosine = ::cos(theta);
  const double sine = ::sin(theta);
  KerrFunctions f{};
  f.sigma = r * r + a2 * cosine * cosine;
  // As a product of its roots: near an extremal horizon the sum of its terms loses all digits.
  const double horizon = horizon_radius(spin);
  f.delta = (r - horizon) * (r - a2 / horizon);
  f.area = (r * r + a2) * (r * r + a2) - a2 * f.delta * sine * sine;
  f.frame_dragging = 2.0 * spin * r / f.area;
  // 1 - ΣΔ/A without cancellation: A - ΣΔ = 2r (r² + a²).
  f.rain_speed = ::sqrt(2.0 * r * (r * r + a2) / f.area);
  f.circumference_factor = ::sqrt(f.area / f.sigma);
  return f;
}

}  // namespace ergodome::inline ERGO_TARGET
