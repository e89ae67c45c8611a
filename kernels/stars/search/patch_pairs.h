#pragma once

#include <cstdint>

#include "kernels/launch/kernel.h"
#include "kernels/stars/search/star_patch.h"

// Batches of pairs of a patch and a star, to find where in the patch the star is.
namespace ergodome {

//! A star that a patch may hold.
struct SearchedPair {
  std::int32_t patch;
  std::int32_t star;  //!< index in SearchedField::stars
  float depth;        //!< cosine of the angle to the patch's axis
  float a;            //!< (a, b): the star in gnomonic projection about the patch's axis
  float b;
  bool mirrored;  //!< the star is in the other half of a mirrored sky
};

//! Pairs of a patch and a star that it may hold.
struct PatchPairBatch {
  int count;
  const SearchedPair* pairs;
  const StarPatch* patches;  //!< all patches, indexed by SearchedPair::patch
};

//! Position of a star relative to the border of a patch.
enum class PatchSide { outside, inside, beside };

//! Finds for each pair whether the star is within the border of the patch's image on the sky. If
//! so, a patch that is one to one holds the star.
struct PatchSideBatch {
  PatchPairBatch pairs;
  float* side;  //!< a PatchSide; `beside`: too near to the border to decide
};

//! Limits of Newton's method.
struct NewtonLimits {
  float farthest;  //!< maximum first step, as a fraction of the patch
  int rounds;
};

//! Seeks each star by Newton's method from the middle of its patch.
struct PatchNewtonBatch {
  PatchPairBatch pairs;
  NewtonLimits limits;
  float* found;  //!< 1 where the method has found the star, 0 elsewhere
  float* u;      //!< position (u, v) found in the patch's unit square; may lie outside [0, 1]²
  float* v;
  //! Jacobian determinant at the position found: area in the plane z = 1 of the patch's frame per
  //! area of the unit square; negative for inverted parity.
  float* area;
};

template <>
struct Kernel<PatchSideBatch> : KernelDefaults {
  static constexpr bool counted = false;
  static const char* name(const PatchSideBatch& /*batch*/) { return "find_patch_sides"; }
  static int elements(const PatchSideBatch& batch) { return batch.pairs.count; }
};

template <>
struct Kernel<PatchNewtonBatch> : KernelDefaults {
  static constexpr bool counted = false;
  static const char* name(const PatchNewtonBatch& /*batch*/) { return "invert_patches"; }
  static int elements(const PatchNewtonBatch& batch) { return batch.pairs.count; }
};

}  // namespace ergodome
