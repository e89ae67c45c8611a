#pragma once

#include "kernels/near_rays/near_ray.h"

// Decides whether rays turn, fall into the hole or escape.
namespace ergodome::inline ERGO_TARGET {

//! The barrier between the horizon and infinity that may turn a ray back, on either side of it.
template <class Real>
struct RadialFate {
  MaskOf<Real> turns;  //!< a barrier outside the horizon turns back a ray that comes to it
  Real barrier_u;      //!< 1/r of the barrier's top [1/M]; light past it does not turn any more
};

//! Finds the fate of a ray from the barrier as radial_barrier() does
//! (kernels/spacetime/geodesic/radial_potential.h), for any sign of the energy. With U = u_rate²,
//!   U' / 2u = (a² E² - C) + 3 K u - 2 a² Q u²,
//!   U = (E + (a² E - a L) u²)² - K u² (1 - r_+ u)(1 - (a²/r_+) u).
template <class T>
ERGO_HD RadialFate<RealOf<T>> radial_fate(ScalarOf<T> spin, const NearRay<T>& ray) {
  using S = ScalarOf<T>;
  using Real = RealOf<T>;
  const S a2 = spin * spin;
  const S horizon_r = kerr_horizon_radius(spin);
  const Real zero(S(0));
  const Real energy = value_of(ray.energy);
  const Real shear = value_of(ray.shear_constant);
  const Real c = value_of(ray.polar_constant) - a2 * (energy * energy);
  const Real b = S(3) * shear;
  const Real discriminant = b * b - (S(8) * a2) * (value_of(ray.carter) * c);
  const auto has_minimum = (c > zero) & (discriminant > zero);
  const Real u = select(has_minimum, S(2) * c / (b + safe_sqrt(discriminant)), zero);
  const Real lapse = (S(1) - horizon_r * u) * (S(1) - (a2 / horizon_r) * u);
  const Real moment = energy + (a2 * energy - spin * value_of(ray.axial_angular_momentum)) * (u * u);
  const Real clearance = absolute(moment) - u * safe_sqrt(shear * lapse);
  const MaskOf<Real> turns = has_minimum & (horizon_r * u < Real(S(1))) & (clearance < zero);
  return {turns, u};
}

//! Returns the rays that go inwards for good: nothing between their position and the horizon turns
//! them.
template <class Real>
ERGO_HD MaskOf<Real> keeps_inwards(const RadialFate<Real>& fate, const Real& u, const Real& u_rate) {
  return (u_rate > Real(ScalarOf<Real>(0))) & !(fate.turns & (u < fate.barrier_u));
}

//! Returns the rays that go outwards for good: nothing between their position and infinity turns
//! them.
template <class Real>
ERGO_HD MaskOf<Real> keeps_outwards(const RadialFate<Real>& fate, const Real& u, const Real& u_rate) {
  return (!(u_rate > Real(ScalarOf<Real>(0)))) & !(fate.turns & (u > fate.barrier_u));
}

//! Returns the rays that do not come from the sky: those that end in the hole, at once or after a
//! turn, and those that begin within it and have never been outside.
template <class T>
ERGO_HD MaskOf<RealOf<T>> comes_from_hole(ScalarOf<T> spin, const NearRay<T>& ray) {
  const RadialFate<RealOf<T>> fate = radial_fate(spin, ray);
  const RealOf<T> u = value_of(ray.u);
  const auto escapes = keeps_outwards(fate, u, value_of(ray.u_rate)) | (fate.turns & (u < fate.barrier_u));
  return !(escapes & has_been_outside(spin, ray));
}

}  // namespace ergodome::inline ERGO_TARGET
