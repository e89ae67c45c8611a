#pragma once

#include <initializer_list>

#include "kernels/near_rays/follow_rays.h"
#include "kernels/near_rays/radial_fate.h"

// Where the path of a ray through shells ends.
namespace ergodome::inline ERGO_TARGET {

//! The last shell that a ray meets: the first opaque one on its path, or the last of all.
template <class T>
struct WayEnd {
  T u;              //!< 1 / r of the shell [1/M]
  T side;           //!< 1 if the ray crosses this shell inwards, -1 outwards
  T first_side;     //!< 1 if the ray starts inwards, -1 outwards
  MaskOf<T> meets;  //!< lanes that meet a shell
};

//! Returns whether a ray has reached its end. A ray that should end before its turning point has
//! also ended once it has turned.
template <class T>
ERGO_HD MaskOf<T> has_passed(const WayEnd<T>& end, const T& u, const T& u_rate) {
  const T zero(ScalarOf<T>(0));
  const auto beyond = ((u - end.u) * end.side >= zero) & (u_rate * end.side > zero);
  return beyond | ((end.side * end.first_side > zero) & (u_rate * end.first_side < zero));
}

//! Finds the last shell from the radial potential, without tracing. Outside the horizon light turns
//! at most once, and it reaches a radius on its side of the barrier if the potential is positive
//! there. Rays whose light has never been outside the horizon meet no shell.
template <class T>
ERGO_HD WayEnd<T> way_through_shells(ScalarOf<T> spin, const RayStart<T>& ray, const WatchedShell* shells, int count) {
  using S = ScalarOf<T>;
  const T zero(S(0));
  const T one(S(1));
  const T carter = ray.polar_constant - ray.axial_angular_momentum * ray.axial_angular_momentum;
  const NearRay<T> near = {
      one,       ray.axial_angular_momentum, ray.polar_constant, carter, ray.shear_constant, ray.u, ray.u_rate, ray.m,
      ray.m_rate};
  const RadialFate<T> fate = radial_fate(spin, near);
  const auto inwards = ray.u_rate > zero;
  const auto before_barrier = ray.u < fate.barrier_u;
  const auto turns = fate.turns & ((inwards & before_barrier) | ((!inwards) & (!before_barrier)));
  const MaskOf<T> none = inwards & (!inwards);
  WayEnd<T> end = {zero, one, select(inwards, one, -one), none};
  MaskOf<T> sees = (ray.energy > zero) & has_been_outside(spin, near);
  const auto visit = [&](int k, bool leg_inwards, bool after_turn) {
    const T u(static_cast<S>(shells[k].u));
    const auto reached = ((u < fate.barrier_u) & before_barrier) | ((u >= fate.barrier_u) & (!before_barrier));
    const auto allowed = (!turns) | (reached & (radial_potential(spin, ray, u) > zero));
    const auto own_leg = (leg_inwards != after_turn) ? inwards : !inwards;
    const auto ahead = leg_inwards ? u > ray.u : u < ray.u;
    const auto crossed = sees & own_leg & allowed & (after_turn ? turns : ahead);
    end.u = select(crossed, u, end.u);
    end.side = select(crossed, T(S(leg_inwards ? 1 : -1)), end.side);
    end.meets = end.meets | crossed;
    if (shells[k].opaque) {
      sees = sees & (!crossed);
    }
  };
  for (const bool after_turn : {false, true}) {
    for (int k = 0; k < count; ++k) {
      visit(k, true, after_turn);
    }
    for (int k = count - 1; k >= 0; --k) {
      visit(k, false, after_turn);
    }
  }
  return end;
}

}  // namespace ergodome::inline ERGO_TARGET
