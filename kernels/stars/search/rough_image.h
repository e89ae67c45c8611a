#pragma once

namespace ergodome {

//! An image of a star, roughly: where the grid has it.
struct RoughImage {
  int star;           //!< in the field
  float gamma_turns;  //!< in [0, 1)
  float s;
  float
      sky;  //!< solid angle of the stars' sky per area of the chart there, about; negative where turned over [sr/turn]
  float brighter;  //!< what it may be brighter by than that makes it out to be, as a factor
  bool exact;      //!< it needs no rays
  bool guessed;    //!< the star is so near to a caustic that the grid cannot tell whether there is one
};

//! Images of one star that a patch may hold at the most: two next to a fold, three next to a cusp, four about a small caustic.
inline constexpr int most_roots = 6;

//! Where a patch holds a star. No area: it is folded and so near to the star that it does not know, next to a caustic, whether it does.
struct FoldedRoot {
  float u, v;  //!< within [0, 1]² and a hair beyond, so that on a border neither side loses one
  float area;  //!< of the patch's plane over that of the unit square, there; negative where the patch is turned over
};

//! Roots that may be guesses; the rest of the room is for what Newton's method finds.
inline constexpr int most_guesses = 4;
//! Roots of a patch that are nearer to each other are one.
inline constexpr float same_root = 2e-3F;

}  // namespace ergodome
