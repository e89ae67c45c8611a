#pragma once

#include <cstdint>

#include "kernels/launch/kernel.h"
#include "kernels/spacetime/kerr/camera_station.h"
#include "kernels/spacetime/kerr/frame_boost.h"
#include "kernels/stars/field_star.h"
#include "kernels/stars/search/mended_leaf.h"
#include "kernels/stars/search/rough_image.h"
#include "kernels/stars/search/star_patch.h"
#include "kernels/stars/seen_image.h"
#include "kernels/stars/star_bands.h"

// The search for images of stars in the patches of a lens grid on the GPU: its data and its steps.
namespace ergodome {

//! Maximum number of levels of a star field; each has a quarter of the previous one's stars.
inline constexpr int most_star_levels = 16;

//! The brightest stars, sorted by their position on the sky.
struct StarLevel {
  StarBands stars;
  const std::int32_t* number;  //!< number of each star in the field
  const std::uint8_t* colour;  //!< class of each star
  float left_out;              //!< illuminance of the brightest star that is not in this level
};

//! A field of stars as the search reads it (render/passes/stars/star_field.h).
struct SearchedField {
  StarLevel levels[most_star_levels];  //!< all stars first, then ever fewer
  int level_count;
  const FieldStar* stars;
  const ShiftGain* gains;      //!< one per row of shifts
  const float* greatest_gain;  //!< maximum gain of the stars in the field, for each row
};

//! A star that a patch may hold.
struct SearchedPair {
  std::int32_t patch;
  std::int32_t star;  //!< number in the field
  float depth;        //!< cosine of the angle to the patch's axis
  float a;            //!< (a, b): the star in gnomonic projection about the patch's axis
  float b;
  bool mirrored;
};

//! A list to which many threads append in nondeterministic order.
template <class T>
struct SharedList {
  T* at;
  int room;
  std::int32_t* count;  //!< elements appended, including those dropped for lack of room
};

//! Parts of patches as their stars see them (SeenParts), in a list like SharedList.
struct SharedParts {
  float* at;
  int room;
  std::int32_t* count;
  std::int32_t* lost;  //!< number of parts that any list has dropped for lack of room
};

//! Maximum number of pairs of folded patches that are searched together: enough to occupy a GPU,
//! few enough for their parts to fit into its memory.
inline constexpr int most_searched_together = 1 << 15;

//! Steps of the search, in this order: pairs of all patches, then their roots by the shapes of the
//! patches. Undecided pairs of bent patches are added to those of folded ones. Parts of folded
//! pairs are halved repeatedly, in parallel: a pair next to a fold has hundreds of parts, most
//! pairs have one. Most counts are only known on the GPU, so a step may be launched for as many
//! elements as its list has room for.
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

//! The search for images of stars in the patches of a lens, on the GPU: several threads per patch,
//! then one per pair. On the CPU, RoughImageFinder works on packs of pairs.
struct PatchSearchBatch {
  const StarPatch* patches;
  int patch_count;
  int sides;          //!< 2 if the grid covers half of a sky that is its own mirror image, else 1
  int patch_threads;  //!< threads that share the stars of a patch, as some patches hold thousands
  //! Axis of the cone in which images are sought, in the observer's frame.
  Vector3<double> view_axis;
  double view_half_angle;  //!< half angle of that cone [rad]
  double view_cosine;
  SkyTurn turn;  //!< to the camera's azimuth
  double sine_phi;
  double cosine_phi;
  float faintest;  //!< images of lower illuminance are left out [lx]
  SearchedField field;
  MendedLeaves mended;
  SharedList<SearchedPair> pairs[3];  //!< one list for each shape of patch
  //! Images that need no rays are completed here and stored in `exact` instead of `images`. The
  //! members from `chart` to `exact` serve this.
  bool judges;
  LensChart chart;
  //! Energy at infinity of light that arrives from a rain-frame direction with energy 1.
  DirectionForm<float> energy;
  AberrationOf<float> observer;  //!< between the observer's frame and the rain frame
  BlackbodyTable colours;
  StarLook look;
  SharedList<SeenImage> exact;
  SharedList<RoughImage> images;
  int deepest;  //!< maximum number of halvings of a patch
  //! First pair of the slice; a slice has at most most_searched_together pairs of folded patches.
  int first_folded;
  SharedParts halved[2];     //!< used alternately: parts to be halved, and their halves
  SharedParts plain_parts;   //!< nearly affine parts
  SharedParts folded_parts;  //!< all others that are not to be halved
  FoldedRoot* plain_roots;   //!< one for each plain part; without a root its area is NaN
  FoldedRoot* folded_roots;  //!< two for each folded part
  //! Roots of each pair of a folded patch, in two lists: from plain parts, then from folded parts.
  //! Each list has told_counts roots, which begin at told_first in `told`. While the lists are
  //! filled, told_counts is the number of roots stored so far.
  std::int32_t* told_counts;
  std::int32_t* told_first;
  FoldedRoot* told;
  PatchSearchStep step = PatchSearchStep::find_pairs;
  int count = 0;  //!< number of patches, pairs or parts of this step
  int depth = 0;  //!< number of halvings of the parts to halve
};

template <>
struct Kernel<PatchSearchBatch> : KernelDefaults {
  static constexpr bool wide = false;
  static constexpr bool compiled_once = true;
  static constexpr bool counted = false;
  static const char* name(const PatchSearchBatch& /*batch*/) { return "search_patches"; }
  static int elements(const PatchSearchBatch& batch) { return batch.count; }
};

}  // namespace ergodome
