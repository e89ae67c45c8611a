#pragma once

#include <cstdint>

#include "kernels/stars/field_star.h"
#include "kernels/stars/mended_leaf.h"
#include "kernels/stars/rough_image.h"
#include "kernels/stars/star_bands.h"
#include "kernels/stars/star_patch.h"

namespace ergodome {

//! Levels that a field of stars has at the most: each a quarter of the one before.
inline constexpr int most_star_levels = 16;

//! The brightest stars, by their place on the sky.
struct StarLevel {
  StarBands stars;
  const std::int32_t* number;  //!< in the field
  const std::uint8_t* colour;  //!< class
  float left_out;              //!< illuminance of the brightest that is not among them
};

//! A field of stars as the search reads it (render/stars/star_field.h).
struct SearchedField {
  StarLevel levels[most_star_levels];  //!< all stars, and then fewer and fewer
  int level_count;
  const FieldStar* stars;
  const ShiftGain* gains;      //!< row by row
  const float* greatest_gain;  //!< of the stars that there are, row by row
};

//! A star that a patch may hold.
struct SearchedPair {
  std::int32_t patch;
  std::int32_t star;  //!< in the field
  float depth;        //!< cosine of the angle to the patch's axis
  float a;            //!< where the star is in the plane z = 1 of the patch
  float b;
  bool mirrored;
};

//! A list that many threads write at once; in which order, chance decides.
template <class T>
struct SharedList {
  T* at;
  int room;
  std::int32_t* count;  //!< of all that was to be written, also where there was no room for it
};

//! The search for images of stars in the patches of a lens, one thread a patch and then one a pair: for devices. On the processor
//! RoughImageFinder works on registers of pairs.
struct PatchSearchBatch {
  const StarPatch* patches;
  int patch_count;
  int sides;                  //!< 2: the grid is half of a sky that is its own mirror image
  Vector3<double> view_axis;  //!< the cone in which images are sought, in the observer's frame
  double view_half_angle;     //!< [rad]
  double view_cosine;
  SkyTurn turn;  //!< to the camera's azimuth
  double sine_phi;
  double cosine_phi;
  float faintest;  //!< illuminance below which images are left out [lx]
  SearchedField field;
  MendedLeaves mended;
  SharedList<SearchedPair> pairs[3];  //!< by the shape of the patch
  SharedList<RoughImage> images;
};

//! The parts of the search, one after another: pairs of all patches, and the roots of pairs by their patches' shapes. Bent ones add to the pairs of
//! folded ones.
enum class PatchSearchStep { find_pairs, regular, bent, folded };

}  // namespace ergodome
