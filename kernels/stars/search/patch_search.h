#pragma once

#include <cstdint>

#include "kernels/spacetime/kerr/camera_station.h"
#include "kernels/spacetime/kerr/frame_boost.h"
#include "kernels/stars/field_star.h"
#include "kernels/stars/search/mended_leaf.h"
#include "kernels/stars/search/rough_image.h"
#include "kernels/stars/search/star_patch.h"
#include "kernels/stars/seen_image.h"
#include "kernels/stars/star_bands.h"

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

//! Parts of patches as their stars see them (SeenParts), a list as above.
struct SharedParts {
  float* at;
  int room;
  std::int32_t* count;
  std::int32_t* lost;  //!< counts those of all lists for which there was no room
};

//! Pairs of folded patches whose parts are searched together: so many as fill a device, so few that their parts do not fill its memory.
inline constexpr int most_searched_together = 1 << 15;

//! The search for images of stars in the patches of a lens, some threads a patch and then one a pair: for devices. On the processor
//! RoughImageFinder works on registers of pairs.
struct PatchSearchBatch {
  const StarPatch* patches;
  int patch_count;
  int sides;                  //!< 2: the grid is half of a sky that is its own mirror image
  int patch_threads;          //!< that look for a patch's stars, side by side: some patches hold thousands
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
  //! What a device says of images that need no rays, where `judges`: these are found then, and not among the rough ones.
  bool judges;
  LensChart chart;
  DirectionForm<float> energy;   //!< at infinity, of light that comes from a rain-frame direction with an energy of 1
  AberrationOf<float> observer;  //!< to the rain frame
  BlackbodyTable colours;
  StarLook look;
  SharedList<SeenImage> exact;
  SharedList<RoughImage> images;
  int deepest;       //!< halvings of a patch at the most
  int first_folded;  //!< pairs of folded patches are searched a slice after another, of most_searched_together at the most
  SharedParts halved[2];     //!< by turns: parts to be halved, and their halves
  SharedParts plain_parts;   //!< nearly affine
  SharedParts folded_parts;  //!< all others that are not to be halved
  FoldedRoot* plain_roots;   //!< one of each of the plain parts; those that are none have an area that is not a number
  FoldedRoot* folded_roots;  //!< two of each of the folded ones
  //! How many roots each pair of a folded patch is told by plain parts and by folded ones, two numbers a pair; where they begin in `told`; and so
  //! many as are there already.
  std::int32_t* told_counts;
  std::int32_t* told_first;
  FoldedRoot* told;
};

//! The steps of the search, one after another: pairs of all patches, the roots of pairs by their patches' shapes; bent patches add to the pairs of folded
//! ones. Those are halved again and again, side by side: a pair next to a fold has hundreds of parts, most have one. How many there are of most things the
//! device alone knows: a step may be run for more, up to the room of their list.
enum class PatchSearchStep {
  find_pairs,
  regular,
  bent,
  see_folded,
  halve,
  solve_plain,
  solve_folded,
  tell_plain,
  tell_folded,
  take_roots
};

}  // namespace ergodome
