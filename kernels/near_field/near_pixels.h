#pragma once

#include "kernels/core/dual.h"
#include "kernels/near_field/series_search.h"

// What the rays of pictures of the near field share.
namespace ergodome::inline ERGO_TARGET {

//! Order of their Taylor series, as of the sky's.
inline constexpr int near_order = 10;

//! Whether light from inside a radius may come along a ray: from outside it must go inwards, and not turn before.
template <class T>
ERGO_HD MaskOf<T> may_reach(ScalarOf<T> spin, const NearRay<Dual<T>>& ray, ScalarOf<T> r) {
  using S = ScalarOf<T>;
  // A pixel's width beyond an edge is still the edge's.
  const S u = S(0.9) / r;
  const S a2 = spin * spin;
  const T e2 = ray.energy.value * ray.energy.value;
  const T potential = e2 + (u * u) * ((a2 * e2 - ray.polar_constant.value) +
                                      u * (S(2) * ray.shear_constant.value - (a2 * u) * ray.carter.value));
  const auto within = ray.u.value > T(u);
  return within | ((ray.u_rate.value > T(S(0))) & (potential > T(S(0))));
}

}  // namespace ergodome::inline ERGO_TARGET
