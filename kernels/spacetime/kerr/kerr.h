#pragma once

#include <cmath>

#include "kernels/spacetime/spacetime.h"

// Kerr spacetime in Boyer-Lindquist coordinates, G = c = M = 1, signature (-,+,+,+):
//   Σ = r² + a² cos²θ,  Δ = r² - 2r + a²,  A = (r² + a²)² - a² Δ sin²θ.
namespace ergodome::inline ERGO_TARGET {

//! Returns the azimuth of ingoing Kerr coordinates minus the Boyer-Lindquist azimuth [rad]: ∫ a dr
//! / Δ from infinity to r. The two agree far away. Finite on both sides of the horizon, infinite at
//! it; the same holds for an extremal hole.
ERGO_HD double ingoing_turn(Spacetime spacetime, double r) {
  const double spin = spacetime.spin;
  const double outer = horizon_radius(spacetime);
  const double inner = inner_horizon_radius(spacetime);
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
ERGO_HD double ingoing_lag(Spacetime spacetime, double r) {
  const double outer = horizon_radius(spacetime);
  const double inner = inner_horizon_radius(spacetime);
  const double gap = outer - inner;
  // log1p avoids cancellation where the horizons are close.
  const double part = gap / (r - outer);
  return 2.0 * outer * (part > 1e-12 ? ::log1p(part) / gap : 1.0 / (r - outer));
}

//! Returns ingoing_lag() outside the horizon, and 0 inside, where light delays are in infalling
//! time.
ERGO_HD double outer_lag(Spacetime spacetime, double r) {
  return r > horizon_radius(spacetime) ? ingoing_lag(spacetime, r) : 0.0;
}

//! The metric functions at one position.
struct KerrFunctions {
  double sigma;                 //!< Σ = r² + a² cos²θ [M²]
  double delta;                 //!< Δ = r² - 2 r + a² [M²]
  double area;                  //!< A = (r² + a²)² - a² Δ sin²θ [M⁴]
  double frame_dragging;        //!< ω = 2 a r / A, angular velocity of the ZAMO [1/M]
  double rain_speed;            //!< speed of free fall from rest at infinity, in the ZAMO frame
  double circumference_factor;  //!< √(A / Σ) [M]: proper radius of the circle of latitude / sinθ
};

//! Evaluates the metric functions at (r, θ) [M, rad], r > 0. Also accurate on the spin axis, at the
//! horizon and inside it.
ERGO_HD KerrFunctions kerr_functions(Spacetime spacetime, double r, double theta) {
  const double spin = spacetime.spin;
  const double a2 = spin * spin;
  const double cosine = ::cos(theta);
  const double sine = ::sin(theta);
  KerrFunctions f{};
  f.sigma = r * r + a2 * cosine * cosine;
  // Computes Δ from its roots: near an extremal horizon the sum of its terms loses all digits.
  const double horizon = horizon_radius(spacetime);
  f.delta = (r - horizon) * (r - a2 / horizon);
  f.area = (r * r + a2) * (r * r + a2) - a2 * f.delta * sine * sine;
  f.frame_dragging = 2.0 * spin * r / f.area;
  // 1 - ΣΔ/A without cancellation: A - ΣΔ = 2r (r² + a²).
  f.rain_speed = ::sqrt(2.0 * r * (r * r + a2) / f.area);
  f.circumference_factor = ::sqrt(f.area / f.sigma);
  return f;
}

}  // namespace ergodome::inline ERGO_TARGET
