#pragma once

#include "kernels/stars/search/seen_patch.h"

namespace ergodome::inline ERGO_TARGET {

//! A place in a patch.
template <class T>
struct PatchPlace {
  T u, v;
};

//! Where in a patch Newton's method ended.
template <class T>
struct PatchRoot {
  PatchPlace<T> at;
  T area;  //!< of the plane over that of the unit square, there
  MaskOf<T> found;
};

//! In parts of what is searched: Newton's last step, which leaves no more than its square.
inline constexpr float settled_step = 1e-3F;
//! Of Newton's method to a root inside a regular patch: half the patch, and as much of that as the Jacobian may change.
inline constexpr float farthest_regular = 0.51F * (1.3F + most_regular_change);
//! Images are sought so far beyond a patch, in parts of it: on borders, neither side may lose one.
inline constexpr float beyond_patch = 2e-3F;

//! Lanes whose place lies within a patch, and `margin` beyond.
template <class T>
ERGO_HD MaskOf<T> within_patch(const PatchPlace<T>& at, float margin) {
  return (at.u > T(-margin)) & (at.u < T(1.0F + margin)) & (at.v > T(-margin)) & (at.v < T(1.0F + margin));
}

//! Seeks stars by Newton's method from a place in their patches. A first step longer than `farthest` ends it, and so does leaving the
//! patch by more than its size.
template <class T>
ERGO_HD PatchRoot<T> newton_on_patch(const SeenPatch<T>& patch, const MaskOf<T>& wanted, const PatchPlace<T>& from,
                                     float farthest, int rounds) {
  PatchPlace<T> at = from;
  T area(1.0F);
  MaskOf<T> active = wanted;
  MaskOf<T> found = T(1.0F) < T(0.0F);
  for (int round = 0; round < rounds && any(active); ++round) {
    const PlaneValue<T> f = seen_at(patch, at.u, at.v);
    const T det = determinant(f);
    const T inverse = T(1.0F) / det;
    const T du = (f.p * f.q_v - f.p_v * f.q) * inverse;
    const T dv = (f.p_u * f.q - f.p * f.q_u) * inverse;
    const T length = maximum(absolute(du), absolute(dv));
    // The comparison is false for what is not a number.
    active = active & (length < T(round == 0 ? farthest : 1e6F));
    // A step of nothing may be less than nothing by its sign.
    const T part = minimum(T(1.0F), T(0.5F) / maximum(length, T(1e-30F)));
    at.u = select(active, at.u - part * du, at.u);
    at.v = select(active, at.v - part * dv, at.v);
    area = select(active, det, area);
    active = active & within_patch(at, 1.0F);
    const MaskOf<T> settled = active & (length < T(settled_step));
    found = found | settled;
    active = active & !settled;
  }
  return {at, area, found};
}

}  // namespace ergodome::inline ERGO_TARGET
