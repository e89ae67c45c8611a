#pragma once

#include "kernels/stars/search/patch_pairs.h"

namespace ergodome {

//! Numbers that a part of a patch is to a star: its control points as seen from there, and whose it is. Arrays of all parts, one after
//! another.
enum PartChannel : int {
  part_p = 0,   //!< 16 control points, row after row along v: p = x - a z
  part_q = 16,  //!< and q = y - b z, which are both 0 where the star is
  part_u = 32,  //!< where in the patch it begins
  part_v = 33,
  part_size_u = 34,  //!< how much of the patch it is; told of those that are not to be halved
  part_size_v = 35,
  part_pair = 36,      //!< whose it is
  part_error = 37,     //!< how far the patch may be from the sky, in its plane
  part_halvings = 38,  //!< at most, until Newton's method is trusted though the part is not regular
  part_channels = 39
};

//! Parts of patches, each as one star sees it: channel c of part i is at[c * room + i].
struct SeenParts {
  float* at;
  int room;
  int count;
};

//! Whole patches as their stars see them. Halvings and error are told beside.
struct SeePatchesBatch {
  PatchPairBatch pairs;
  const float* error;  //!< see PartChannel
  const float* halvings;
  SeenParts whole;  //!< room for `pairs.count`
};

//! Room that a list of parts has to have behind its last one: registers are written whole.
inline constexpr int part_padding = 16;

//! Halves parts where their control points leave room for the star, down to those for which Newton's method is safe. All have been halved
//! `depth` times.
struct HalvePartsBatch {
  SeenParts parts;
  int first;  //!< of the parts taken
  int last;   //!< behind them
  int depth;
  // Lists have room for two of each part, and part_padding more.
  SeenParts* halves;   //!< to be halved again
  SeenParts* regular;  //!< nearly affine: Newton's method finds the only root
  SeenParts* folded;   //!< all others that are not to be halved
};

//! Roots that a part may give: next to a fold, one and its twin, or two that are guessed.
inline constexpr int most_part_roots = 2;

//! Seeks stars in parts. Root k of part i is told at [k * count + i], of parts that are not folded the first alone.
struct SolvePartsBatch {
  SeenParts parts;
  bool folded;   //!< they may be: roots are sought beside them, too, and across the fold
  float* found;  //!< 1 for a root, 0 for none
  float* u;      //!< in the patch
  float* v;
  float* area;  //!< of the plane over that of the patch's unit square; negative where it is turned over, 0 for a guess
};

}  // namespace ergodome
