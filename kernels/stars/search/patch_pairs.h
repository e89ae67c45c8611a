#pragma once

#include "kernels/stars/search/bezier_patch.h"

namespace ergodome {

//! Patches that map the chart one to one, each with a star that it may hold. Arrays hold `count` elements.
struct PatchPairBatch {
  int count;
  const BezierPatch* const* patch;
  const float* a;  //!< where the star is in the plane z = 1 of the patch
  const float* b;
};

//! What a patch's border says about a star.
enum class PatchSide { outside, inside, beside };

//! Tells for each pair whether the star is within the border of the patch's image: a patch that is one to one holds it, then.
struct PatchSideBatch {
  PatchPairBatch pairs;
  float* side;  //!< a PatchSide; `beside`: too near to the border to tell
};

//! Seeks each star by Newton's method from the middle of its patch.
struct PatchNewtonBatch {
  PatchPairBatch pairs;
  float farthest;  //!< in parts of the patch: a first step longer than this ends it
  int rounds;
  float* found;  //!< 1 where it ended at a star, 0 elsewhere
  float* u;      //!< where, though it be outside of [0, 1]²
  float* v;
  float* area;  //!< of the plane over that of the unit square, there; negative where the patch is turned over
};

}  // namespace ergodome
