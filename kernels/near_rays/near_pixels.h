#pragma once

#include "kernels/core/dual.h"
#include "kernels/near_rays/series_search.h"

// Definitions shared by all rays that draw the near field (disk, shells and objects).
namespace ergodome::inline ERGO_TARGET {

//! Order of the Taylor series of these rays, the same as for rays to the sky.
inline constexpr int near_order = 10;

//! Returns the lanes in which light from inside radius r may come along the ray. From outside, the
//! ray has to go inwards and not turn before.
template <class T>
ERGO_HD MaskOf<RealOf<T>> may_reach(ScalarOf<T> spin, const NearRay<T>& ray, ScalarOf<T> r) {
  using S = ScalarOf<T>;
  using Real = RealOf<T>;
  // A pixel just outside an edge may still be partly covered, so the radius is slightly enlarged.
  const S u = S(0.9) / r;
  const S a2 = spin * spin;
  const Real e2 = value_of(ray.energy) * value_of(ray.energy);
  const Real potential = e2 + (u * u) * ((a2 * e2 - value_of(ray.polar_constant)) +
                                         u * (S(2) * value_of(ray.shear_constant) - (a2 * u) * value_of(ray.carter)));
  const auto within = value_of(ray.u) > Real(u);
  return within | ((value_of(ray.u_rate) > Real(S(0))) & (potential > Real(S(0))));
}

}  // namespace ergodome::inline ERGO_TARGET
