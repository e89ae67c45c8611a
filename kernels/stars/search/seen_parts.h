#pragma once

#include "kernels/launch/kernel.h"
#include "kernels/stars/search/patch_pairs.h"

// Batches of the search in folded patches: parts of patches as stars see them, halved until
// Newton's method is safe in each.
namespace ergodome {

//! The channels of a part of a patch: its control points as seen from the star, its position, and
//! the pair that it belongs to. Each channel is an array over all parts.
enum PartChannel : int {
  part_p = 0,   //!< 16 control points, row after row along v: p = x - a z
  part_q = 16,  //!< 16 control points: q = y - b z; p and q are 0 at the star
  part_u = 32,  //!< where the part begins in the patch, in [0, 1] along u; next channel: along v
  part_v = 33,
  part_size_u = 34,  //!< extent along u, as a fraction of the patch's; next channel: along v
  part_size_v = 35,
  part_pair = 36,   //!< index of the pair
  part_error = 37,  //!< maximum deviation of the patch from the true sky, in the patch's plane
  //! Number of halvings after which Newton's method is used even if the part is not regular.
  part_halvings = 38,
  part_channels = 39
};

//! Parts of patches, each as one star sees it: channel c of part i is at[c * room + i].
struct SeenParts {
  float* at;
  int room;
  int count;
};

//! Converts whole patches to parts in the coordinates of their stars (SeenPatch).
struct SeePatchesBatch {
  PatchPairBatch pairs;
  SeenParts whole;  //!< needs room for `pairs.count` parts
};

//! Extra room that a list of parts needs behind its last element, since packs are written whole.
inline constexpr int part_padding = 16;

//! Lists to which the halves of parts are added.
enum PartList : int {
  to_halve,       //!< to be halved again
  regular_parts,  //!< nearly affine: Newton's method finds the only root
  folded_parts,   //!< parts that are neither nearly affine nor to be halved
  part_lists
};

//! Halves parts that have been halved `depth` times, and sorts the halves whose control points may
//! enclose the star into lists.
struct HalvePartsBatch {
  SeenParts parts;
  int first;  //!< first part to be halved
  int last;   //!< one past the last part to be halved
  int depth;
  //! Output lists, indexed by PartList. Each list needs room for two halves per part, plus
  //! part_padding.
  SeenParts* lists[part_lists];
};

//! Maximum number of roots of a part: a root and its twin across a fold, or two guesses.
inline constexpr int max_part_roots = 2;

//! Seeks stars in parts. Root k of part i is stored at [k * count + i]; parts that are not folded
//! have only root 0.
struct SolvePartsBatch {
  SeenParts parts;
  bool folded;   //!< parts may be folded: roots are also sought outside the parts and across the fold
  float* found;  //!< 1 for a root, 0 for none
  float* u;      //!< position (u, v) of the root in the patch's unit square
  float* v;
  //! Area in the plane z = 1 of the patch's frame per area of the patch's unit square; negative for
  //! inverted parity, 0 for a guess.
  float* area;
};

template <>
struct Kernel<SeePatchesBatch> : KernelDefaults {
  static constexpr bool counted = false;
  static const char* name(const SeePatchesBatch& /*batch*/) { return "see_patches"; }
  static int elements(const SeePatchesBatch& batch) { return batch.pairs.count; }
};

template <>
struct Kernel<HalvePartsBatch> : KernelDefaults {
  static constexpr bool counted = false;
  static const char* name(const HalvePartsBatch& /*batch*/) { return "halve_parts"; }
  static int elements(const HalvePartsBatch& /*batch*/) { return 1; }
};

template <>
struct Kernel<SolvePartsBatch> : KernelDefaults {
  static constexpr bool counted = false;
  static const char* name(const SolvePartsBatch& /*batch*/) { return "solve_parts"; }
  static int elements(const SolvePartsBatch& batch) { return batch.parts.count; }
};

}  // namespace ergodome
