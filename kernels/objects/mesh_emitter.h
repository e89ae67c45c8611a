#pragma once

#include "kernels/core/arithmetic.h"
#include "kernels/objects/mesh_search.h"
#include "kernels/shells/shell_emitter.h"

namespace ergodome::inline ERGO_TARGET {

//! Returns ν_emitted / ν_observed of light from matter that moves with dx/dt = `velocity`
//! (pseudo-Cartesian, in the hole's time), at a hit of a ray of energy E and axial angular momentum
//! L_z [M] at infinity: -p_μ U^μ = U^t (E - p_r dr/dt - p_θ dθ/dt - L dφ/dt). Where nothing can
//! move at this velocity (faster than light, or at rest in the ergosphere), returns the ratio for
//! an observer without angular momentum.
ERGO_HD double emitted_frequency(Spacetime spacetime, const MeshHit& hit, double energy, double axial_angular_momentum,
                                 const Vector3<double>& velocity) {
  const double spin = spacetime.spin;
  const double a2 = spin * spin;
  const double r = ::sqrt(dot(hit.point, hit.point));
  const Vector3<double> n = (1.0 / r) * hit.point;
  const double radial = dot(n, velocity);
  const Vector3<double> turn = (1.0 / r) * (velocity - radial * n);
  // sin²θ dφ/dt, which is regular on the spin axis, as is everything below.
  const double axial = n.x * turn.y - n.y * turn.x;
  const double sine2 = n.x * n.x + n.y * n.y;
  const double horizon_r = kerr_horizon_radius(spin);
  const double delta = (r - horizon_r) * (r - a2 / horizon_r);
  const double sigma = r * r + a2 * (n.z * n.z);
  const double pull = 2.0 * r / sigma;
  // -ds²/dt² along the path of the matter.
  const double square = 1.0 - pull + 2.0 * pull * spin * axial - sigma / delta * (radial * radial) -
                        sigma * dot(turn, turn) - a2 * (1.0 + pull) * (axial * axial);
  if (!(square > 0.0)) {
    return zamo_frequency(spin, r, ::sqrt(sine2), n.z, energy, axial_angular_momentum);
  }
  const double radial_momentum = hit.u_rate * (r * r) / delta;
  const double seen = energy - radial_momentum * radial + dot(hit.polar_momentum, turn);
  return seen / ::sqrt(square);
}

}  // namespace ergodome::inline ERGO_TARGET
