#pragma once

#include <cstdint>

#include "kernels/launch/kernel.h"
#include "kernels/spacetime/kerr/camera_station.h"
#include "kernels/spacetime/kerr/frame_boost.h"
#include "kernels/stars/search/rough_image.h"
#include "kernels/stars/search/search_inputs.h"
#include "kernels/stars/search/seen_parts.h"
#include "kernels/stars/seen_image.h"

// The GPU's driver of the search for images of stars in the patches of a lens grid: its data, and
// the order of its launches. The steps themselves are in search_steps.h.
namespace ergodome {

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
inline constexpr int max_searched_together = 1 << 15;

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
  solve_regular,
  solve_folded,
  list_regular,
  list_folded,
  take_roots
};

//! The search for images of stars in the patches of a lens, on the GPU: several threads per patch,
//! then one per pair. On the CPU, RoughImageFinder works on packs of pairs.
struct PatchSearchBatch {
  SearchInputs inputs;
  int patch_threads;                  //!< threads that share the stars of a patch, as some patches hold thousands
  SharedList<SearchedPair> pairs[3];  //!< one list for each shape of patch
  //! Images that need no rays are completed here and stored in `exact` instead of `images`. The
  //! members from `chart` to `exact` are only used for that.
  bool completes;
  LensChart chart;
  //! Energy at infinity of light that arrives from a rain-frame direction with energy 1.
  DirectionForm<float> energy;
  AberrationOf<float> observer;  //!< aberration from the observer's frame to the rain frame
  BlackbodyTable colours;
  StarAppearance appearance;
  SharedList<SeenImage> exact;
  SharedList<RoughImage> images;
  int deepest;  //!< maximum number of halvings of a patch
  //! First pair of the slice; a slice has at most max_searched_together pairs of folded patches.
  int first_folded;
  SharedParts halved[2];      //!< used alternately: parts to be halved, and their halves
  SharedParts regular_parts;  //!< nearly affine parts
  SharedParts folded_parts;   //!< parts that are neither nearly affine nor to be halved
  //! Roots: one for each regular part, two for each folded part. Without a root, the area is NaN.
  FoldedRoot* regular_roots;
  FoldedRoot* folded_roots;
  //! Roots of each pair of a folded patch and a star, in two lists: from regular parts, then from
  //! folded parts. Each list has root_counts roots, which begin at root_first in `roots`. While the
  //! lists are filled, root_counts is the number of roots stored so far.
  std::int32_t* root_counts;
  std::int32_t* root_first;
  FoldedRoot* roots;
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
