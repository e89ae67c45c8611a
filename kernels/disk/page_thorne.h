#pragma once

#include "kernels/disk/disk_emitter.h"

// Flux of a thin disk in a steady state: Page & Thorne, ApJ 191 (1974) 499, with no torque at the
// innermost stable orbit.
namespace ergodome::inline ERGO_TARGET {

namespace detail {

//! Returns a term of eq. 15n, without its minus sign: the integral of B / (x - root) from x0, with
//! B = 3 (root - a)² / (root product), where product = (root - other)(root - another) is over the
//! two other roots. If the root is 0, or if two roots meet (a = ±1), the limit is 0.
ERGO_HD double page_thorne_term(double spin, double root, double product, double x0, double x) {
  if (::fabs(root) < 1e-12 || ::fabs(product) < 1e-9) {
    return 0.0;
  }
  return 3.0 * (root - spin) * (root - spin) / (root * product) * ::log((x - root) / (x0 - root));
}

}  // namespace detail

//! Returns the function f of eq. 15n at radius r, times M: 0 at the innermost stable orbit and
//! inside it. Matter orbits along +φ.
//!
//! With x = √r, and x1, x2, x3 the roots of x³ - 3x + 2a:
//!   f = 3 / (2 x² (x³ - 3x + 2a)) [x - x0 - 3/2 a ln(x/x0)
//!       - Σ 3 (x_i - a)² / (x_i (x_i - x_j)(x_i - x_k)) ln((x - x_i) / (x0 - x_i))].
ERGO_HD double page_thorne_function(Spacetime spacetime, double r) {
  const double spin = spacetime.spin;
  const double stable_r = innermost_stable_radius(spacetime, 1.0);
  if (!(r > stable_r)) {
    return 0.0;
  }
  const double x = ::sqrt(r);
  const double x0 = ::sqrt(stable_r);
  const double third = ::acos(::fmin(::fmax(spin, -1.0), 1.0)) / 3.0;
  // The roots x1 = 2 cos(third - π/3), x2 = 2 cos(third + π/3) and x3 = -2 cos(third), and their
  // differences without cancellation.
  const double cosine = ::cos(third);
  const double skew = 1.73205080756887729353 * ::sin(third);
  const double x1 = cosine + skew;
  const double x2 = cosine - skew;
  const double x3 = -2.0 * cosine;
  const double d12 = 2.0 * skew;
  const double d13 = 3.0 * cosine + skew;
  const double d23 = 3.0 * cosine - skew;
  const double bracket = x - x0 - 1.5 * spin * ::log(x / x0) - detail::page_thorne_term(spin, x1, d12 * d13, x0, x) -
                         detail::page_thorne_term(spin, x2, -d12 * d23, x0, x) -
                         detail::page_thorne_term(spin, x3, d13 * d23, x0, x);
  return 1.5 * bracket / (x * x * (x * x * x - 3.0 * x + 2.0 * spin));
}

//! Returns the flux of one face of the disk at radius r, as measured by its own matter, in units of
//! the accretion rate over 4π M²: f / r, from eq. 11b at the equator.
ERGO_HD double page_thorne_flux(Spacetime spacetime, double r) { return page_thorne_function(spacetime, r) / r; }

}  // namespace ergodome::inline ERGO_TARGET
