#pragma once

#include "kernels/core/arithmetic.h"

// Emitters on a shell: observers without angular momentum (ZAMO), who exist everywhere outside the
// horizon. Static observers do not exist in the ergosphere. (Bardeen, Press & Teukolsky 1972,
// section III.)
namespace ergodome::inline ERGO_TARGET {

//! Returns ν_emitted / ν_observed for a zero-angular-momentum observer at (r, θ): (E - ω L) / α,
//! with ω = 2 a r / A and α² = Σ Δ / A. `energy` and L_z [M] are those at infinity, for an observed
//! energy of 1. Infinite at the horizon.
//!
//! Next to the horizon, E and ω L nearly cancel for light that moves with the hole's rotation. The
//! result is therefore at least the photon's azimuthal momentum there, |L| / (√(A/Σ) sinθ), in
//! which nothing cancels.
template <class S>
ERGO_HD S zamo_frequency(S spin, S r, S sine, S cosine, S energy, S axial_angular_momentum) {
  const S a2 = spin * spin;
  const S horizon_r = kerr_horizon_radius(spin);
  // Δ from its roots, so that nothing cancels next to the horizon.
  const S delta = (r - horizon_r) * (r - a2 / horizon_r);
  const S sigma = r * r + a2 * cosine * cosine;
  const S sum = r * r + a2;
  const S area = sum * sum - a2 * delta * sine * sine;
  const S azimuthal = absolute(axial_angular_momentum) * sqrt(sigma / area) / maximum(sine, S(1e-3));
  return maximum((energy - S(2) * spin * r / area * axial_angular_momentum) * sqrt(area / (sigma * delta)), azimuthal);
}

}  // namespace ergodome::inline ERGO_TARGET
