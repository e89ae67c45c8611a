#pragma once

#include <cstdint>

#include "kernels/core/arithmetic.h"

// The spacetime in which light and observers move: what defines it, its characteristic radii, and
// where light can end. Radii are those of Bardeen, Press & Teukolsky, ApJ 178 (1972) 347.
namespace ergodome {

//! Kerr spacetime with G = c = M = 1; the hole's spin axis is +z.
//!
//! It holds what defines the spacetime and nothing else: radii are computed, so creating one costs
//! nothing, and kernels are as fast as with the bare number.
struct Spacetime {
  double spin = 0.0;  //!< a [M], in [-1, 1], positive along +z; without spin, Schwarzschild

  Spacetime() = default;
  //! Always inlined: object files for different instruction sets must not share functions.
  [[gnu::always_inline]] ERGO_HD constexpr explicit Spacetime(double a) : spin(a) {}

  bool operator==(const Spacetime&) const = default;
};

//! Where light ends that is followed from the camera backwards in time. Kernels store it as a
//! number.
enum class LightEnd : std::int32_t {
  sky = 0,        //!< comes from the celestial sphere
  horizon = 1,    //!< comes from the hole: dark
  unresolved = 2  //!< the step limit was reached before the sky direction was known
};

inline namespace ERGO_TARGET {

//! Returns the radius of the outer event horizon [M]: 1 + √(1 - a²). Without a branch, unlike
//! kerr_horizon_radius(), because branches change which operations compilers fuse around it.
ERGO_HD double horizon_radius(Spacetime spacetime) {
  return 1.0 + ::sqrt(::fmax(0.0, (1.0 - spacetime.spin) * (1.0 + spacetime.spin)));
}

//! Returns the radius of the outer horizon [M] for the spin of a camera, in the precision of its
//! rays.
template <class S>
ERGO_HD S kerr_horizon_radius(S spin) {
  return S(1) + safe_sqrt((S(1) - spin) * (S(1) + spin));
}

//! Returns the radius of the inner horizon [M]: 1 - √(1 - a²); 0 without spin.
ERGO_HD double inner_horizon_radius(Spacetime spacetime) {
  return spacetime.spin * spacetime.spin / horizon_radius(spacetime);
}

//! Returns the smallest radius that cameras may have inside the horizon [M]: the inner horizon's,
//! plus 2 % of the gap between the horizons. At the inner horizon all light of the exterior's
//! future arrives at once; without spin it is at the singularity. At spin 1 this is the horizon
//! radius.
ERGO_HD double min_interior_radius(Spacetime spacetime) {
  const double inner = inner_horizon_radius(spacetime);
  return inner + 0.02 * (horizon_radius(spacetime) - inner);
}

//! Returns the radius up to which cameras are near the horizon [M]; see is_near_horizon().
ERGO_HD double near_horizon_radius(Spacetime spacetime) { return 1.2 * horizon_radius(spacetime); }

//! Returns whether a camera is inside the horizon or so close to it that, in float, 1 / Δ would
//! spoil the Boyer-Lindquist azimuth.
ERGO_HD bool is_near_horizon(Spacetime spacetime, double r) { return r <= near_horizon_radius(spacetime); }

//! Returns the outer radius of the ergosphere at polar angle θ [M]. Below it, nothing can be at
//! rest relative to the stars.
ERGO_HD double static_limit_radius(Spacetime spacetime, double theta) {
  const double a_cosine = spacetime.spin * ::cos(theta);
  return 1.0 + ::sqrt(::fmax(0.0, 1.0 - a_cosine * a_cosine));
}

//! Returns the radius of the circular equatorial photon orbit [M] in the sense of `orbit_sign` (+1:
//! along +φ; -1: against it). Eq. 2.18.
ERGO_HD double photon_orbit_radius(Spacetime spacetime, double orbit_sign) {
  return 2.0 * (1.0 + ::cos(2.0 / 3.0 * ::acos(-orbit_sign * spacetime.spin)));
}

//! Returns the radius of the innermost stable circular orbit [M] in the sense of `orbit_sign`. Eq.
//! 2.21.
ERGO_HD double innermost_stable_radius(Spacetime spacetime, double orbit_sign) {
  const double a = orbit_sign * spacetime.spin;
  const double z1 = 1.0 + ::cbrt((1.0 - a) * (1.0 + a)) * (::cbrt(1.0 + a) + ::cbrt(1.0 - a));
  const double z2 = ::sqrt(3.0 * a * a + z1 * z1);
  const double sign = a >= 0.0 ? 1.0 : -1.0;
  return 3.0 + z2 - sign * ::sqrt((3.0 - z1) * (3.0 + z1 + 2.0 * z2));
}

}  // namespace ERGO_TARGET
}  // namespace ergodome
