#pragma once

namespace ergodome {

//! An approximate image of a star, as read from the grid.
struct RoughImage {
  int star;           //!< index of the star in SearchedField::stars
  float gamma_turns;  //!< position angle γ in the chart [turns], in [0, 1)
  float s;
  //! Approximate solid angle of the sky per area of the chart; negative for inverted parity
  //! [sr/turn].
  float sky;
  float brighter;  //!< factor by which the image may be brighter than the grid indicates
  bool exact;      //!< needs no refinement by rays
  bool guessed;    //!< so near to a caustic that the grid cannot decide whether the image exists
};

//! Maximum number of images of one star in a patch: two next to a fold, three next to a cusp, four
//! around a small caustic.
inline constexpr int max_roots = 6;

//! A root of a patch: a position whose light comes from the star. An area of 0 marks a guess: the
//! patch is folded, and it passes the star so closely that its error leaves open whether the image
//! exists.
struct FoldedRoot {
  float u, v;  //!< position in the patch: in [0, 1]² and slightly beyond, so that no root on a border is lost
  //! Jacobian determinant: area in the plane z = 1 of the patch's frame per area of its unit
  //! square; negative for inverted parity.
  float area;
};

//! Guesses are only added below this number of roots; the remaining room is for roots that Newton's
//! method finds.
inline constexpr int max_guesses = 4;
//! Roots of a patch that are nearer to each other than this are the same root.
inline constexpr float same_root = 2e-3F;

}  // namespace ergodome
