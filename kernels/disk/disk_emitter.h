#pragma once

#include "kernels/core/arithmetic.h"
#include "kernels/spacetime/kerr/kerr.h"

// Matter of a thin equatorial disk on circular geodesics along +φ; a negative spin means that it
// orbits against the hole's rotation. (Bardeen, Press & Teukolsky 1972, section II; inside the
// innermost stable orbit Cunningham 1975.)
namespace ergodome {

//! Parameters of the motion of matter in the equatorial plane.
template <class S>
struct DiskFlow {
  S spin;
  //! Innermost stable orbit [M]; inside it matter falls with that orbit's energy and angular
  //! momentum.
  S stable_r;
  S energy;                  //!< energy of the innermost stable orbit, for mass 1
  S axial_angular_momentum;  //!< L_z of the innermost stable orbit, for mass 1 [M]
};

inline namespace ERGO_TARGET {

//! Energy and L_z of a circular orbit along +φ at radius r, for mass 1. Bardeen, Press & Teukolsky
//! (1972), eqs. 2.12 and 2.13.
struct CircularOrbit {
  double energy;
  double axial_angular_momentum;
};

ERGO_HD CircularOrbit circular_orbit(Spacetime spacetime, double r) {
  const double spin = spacetime.spin;
  const double root = ::sqrt(r);
  const double swirl = spin / (r * root);
  const double norm = ::sqrt(1.0 - 3.0 / r + 2.0 * swirl);
  return {(1.0 - 2.0 / r + swirl) / norm, root * (1.0 - 2.0 * swirl + spin * spin / (r * r)) / norm};
}

//! Returns the flow of the disk about a hole: the radius of the innermost stable orbit, with its
//! energy and angular momentum. For spin 1 that radius is the horizon's, and no matter falls
//! inwards from the orbit.
ERGO_HD DiskFlow<double> make_disk_flow(Spacetime spacetime) {
  const double r = innermost_stable_radius(spacetime, 1.0);
  // At spin 1 the formulas yield 0 / 0; these are the limits as the spin goes to 1.
  constexpr double limit_energy = 0.57735026918962576451;
  const bool extremal = 1.0 - spacetime.spin < 1e-12;
  const CircularOrbit orbit = extremal ? CircularOrbit{limit_energy, 2.0 * limit_energy} : circular_orbit(spacetime, r);
  return {spacetime.spin, r, orbit.energy, orbit.axial_angular_momentum};
}

template <class S>
ERGO_HD DiskFlow<S> converted_flow(const DiskFlow<double>& f) {
  return {static_cast<S>(f.spin), static_cast<S>(f.stable_r), static_cast<S>(f.energy),
          static_cast<S>(f.axial_angular_momentum)};
}

//! Light where it leaves the disk, for a photon that the observer sees with energy 1.
template <class S>
struct DiskLight {
  S r;                       //!< radius at which the light leaves the disk [M]
  S energy;                  //!< E: the photon's energy at infinity
  S axial_angular_momentum;  //!< L = L_z of the photon [M]
  S shear_constant;          //!< K = Q + (L - a E)² of the photon [M²]; Q: its Carter constant
  bool outwards;             //!< the light leaves the disk towards larger r
};

//! Returns ν_emitted / ν_observed = u^t (E - Ω L) for matter on a circular geodesic along +φ. The
//! ratio is infinite at and inside the photon orbit, where there is no such geodesic.
template <class S>
ERGO_HD S circular_frequency(S spin, const DiskLight<S>& light) {
  const S swirl = light.r * sqrt(light.r);  // r^(3/2)
  const S norm = S(1) - S(3) / light.r + S(2) * spin / swirl;
  const S momentum = light.axial_angular_momentum / (swirl + spin);
  return norm > S(0) ? (S(1) + spin / swirl) / sqrt(norm) * (light.energy - momentum)
                     : std::numeric_limits<S>::infinity();
}

namespace detail {

//! Returns Δ from its factors, since the sum r² - 2r + a² loses digits next to the horizon of a
//! fast-spinning hole.
template <class S>
ERGO_HD S lapse_at(S spin, S r) {
  const S half_gap = safe_sqrt((S(1) - spin) * (S(1) + spin));
  return (r - S(1) - half_gap) * (r - S(1) + half_gap);
}

//! Returns X = (r² + a²) E - a L, which is above 0 for all light outside the horizon.
template <class S>
ERGO_HD S moment_of(S spin, const DiskLight<S>& light) {
  return light.r * light.r * light.energy - spin * (light.axial_angular_momentum - spin * light.energy);
}

}  // namespace detail

//! Returns whether light with these constants can exist at its radius: X > 0, and X² >= Δ K.
template <class S>
ERGO_HD bool can_be_there(S spin, const DiskLight<S>& light) {
  const S x = detail::moment_of(spin, light);
  return x > S(0) && x * x >= detail::lapse_at(spin, light.r) * light.shear_constant;
}

//! Returns ν_emitted / ν_observed for matter that falls from the innermost stable orbit r_s. With X
//! = (r² + a²) E - a L and W = dr/dλ of the photon, and P and V the same of the matter:
//!   r² ν = (X P ± W V) / Δ - (L_m - a E_m)(L - a E),     W² = X² - Δ K,
//!   V² = P² - Δ M = 2 r (r_s - r)³ / (3 r_s),     M = r² + (L_m - a E_m)²,
//! with - for light that goes inwards, where W V nearly cancels X P next to the horizon, and
//!   (X P - W V) / Δ = (K V² + M X²) / (X P + W V).
//! Linear extrapolation across a pixel may give a radius at which light with these constants cannot
//! exist. The light is then assumed to turn there, which keeps ν above 0.
template <class S>
ERGO_HD S plunging_frequency(const DiskFlow<S>& flow, const DiskLight<S>& light) {
  const S a = flow.spin;
  const S r2 = light.r * light.r;
  const S k = maximum(light.shear_constant, S(0));
  const S delta = detail::lapse_at(a, light.r);
  const S skew = flow.axial_angular_momentum - a * flow.energy;
  const S light_skew = light.axial_angular_momentum - a * light.energy;
  const S x = maximum(detail::moment_of(a, light), safe_sqrt(delta * k));
  const S m = r2 + skew * skew;
  const S way = maximum(flow.stable_r - light.r, S(0));
  const S v2 = S(2) / S(3) * (light.r / flow.stable_r) * (way * way * way);
  // P is a difference that loses digits near a fast-spinning hole, so it is computed as √(V² + Δ
  // M).
  const S both = x * sqrt(v2 + delta * m) + safe_sqrt(x * x - delta * k) * sqrt(v2);
  const S apart = light.outwards ? both / delta : (k * v2 + m * (x * x)) / both;
  return (apart - skew * light_skew) / r2;
}

//! Returns ν_emitted / ν_observed anywhere outside the horizon: on circular orbits down to the
//! innermost stable one, falling inside it.
template <class S>
ERGO_HD S disk_frequency(const DiskFlow<S>& flow, const DiskLight<S>& light) {
  return light.r >= flow.stable_r ? circular_frequency(flow.spin, light) : plunging_frequency(flow, light);
}

}  // namespace ERGO_TARGET
}  // namespace ergodome
