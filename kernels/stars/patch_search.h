#pragma once

#include "kernels/stars/bezier_patch.h"

namespace ergodome {

//! Images of one star that a patch may hold at the most: two next to a fold, three next to a cusp, four about a small caustic.
inline constexpr int most_roots = 6;

//! Stars that may have images in a patch of a lens. Arrays hold `count` elements, those with roots most_roots times as many: first the
//! first root of all stars, then the second.
struct PatchSearchBatch {
  BezierPatch patch;
  PatchShape shape;  //!< not regular: see patch_pairs.h for those
  int halvings;      //!< at most, until Newton's method is trusted though a part is not regular
  //! How far the patch may be from the sky, in its plane. Where it is folded and comes so near to a star, that counts as a root, with no
  //! area: whether there are images, next to a caustic, the patch does not know.
  float error;
  int count;
  const float* a;  //!< where the stars are in the plane z = 1 of the patch
  const float* b;
  float* roots;  //!< how many there are
  float* u;      //!< where, within [0, 1]² and a hair beyond, so that on a border neither side loses one
  float* v;
  float* area;  //!< of the plane over that of the unit square, there; negative where the patch is turned over
};

}  // namespace ergodome
