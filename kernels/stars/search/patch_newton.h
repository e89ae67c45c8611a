#pragma once

#include "kernels/stars/search/seen_patch.h"

// Newton's method for images of stars in patches.
namespace ergodome::inline ERGO_TARGET {

//! A position in a patch.
template <class T>
struct PatchPosition {
  T u, v;
};

//! The point of a patch at which Newton's method ended.
template <class T>
struct PatchRoot {
  PatchPosition<T> at;
  T area;  //!< Jacobian determinant at the root: area in the plane z = 1 per area of the unit square
  MaskOf<T> found;
};

//! Newton's method ends at a step shorter than this [fractions of the patch or part]; the remaining
//! error is about its square.
inline constexpr float settled_step = 1e-3F;
//! Maximum first step of Newton's method in a regular patch: half the patch, plus the change that
//! the Jacobian may have.
inline constexpr float farthest_regular = 0.51F * (1.3F + max_regular_change);
//! Maximum number of Newton steps in regular patches, and in bent ones, which have a fallback.
inline constexpr int rounds_regular = 16;
inline constexpr int rounds_bent = 8;
//! Value for the limit of the first step that means no limit.
inline constexpr float any_step = 1e6F;
//! Images are also accepted this far outside a patch, as a fraction of it, so that none is lost on
//! a border between two patches.
inline constexpr float beyond_patch = 2e-3F;

//! Returns the lanes whose position lies within a patch enlarged by `margin`.
template <class T>
ERGO_HD MaskOf<T> within_patch(const PatchPosition<T>& at, float margin) {
  return (at.u > T(-margin)) & (at.u < T(1.0F + margin)) & (at.v > T(-margin)) & (at.v < T(1.0F + margin));
}

//! Seeks stars by Newton's method from a position in their patches. A lane ends without a root if
//! its first step exceeds `farthest`, if it leaves the patch by more than the patch's size, or
//! after `rounds` steps.
template <class T>
ERGO_HD PatchRoot<T> newton_on_patch(const SeenPatch<T>& patch, const MaskOf<T>& wanted, const PatchPosition<T>& from,
                                     float farthest, int rounds) {
  PatchPosition<T> at = from;
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
    // Also ends lanes whose step is NaN.
    active = active & (length < T(round == 0 ? farthest : any_step));
    // A length of zero may have a minus sign, and 0.5 / -0 is -∞.
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
