#pragma once

#include <functional>
#include <vector>

#include "kernels/stars/search/rough_image.h"
#include "kernels/stars/search/search_inputs.h"
#include "render/passes/stars/search/folded_search.h"

namespace ergodome {

//! The CPU's driver of the search: finds the images in patches that may be bright enough. Collects
//! the stars of many patches, because kernels use many lanes and a patch has only a few stars. The
//! steps are in kernels/stars/search/search_steps.h.
class RoughImageFinder {
 public:
  //! `inputs` must outlive the finder; `star_count`: number of stars in their field.
  RoughImageFinder(const SearchInputs& inputs, std::size_t star_count) : inputs_(inputs), stars_(star_count) {}

  //! Collects the stars that a patch may contain; with `mirrored`, those of the patch's mirror
  //! image in the other half of the sky.
  void add_patch(int number, bool mirrored);

  //! Searches for images in all patches collected so far, and appends them to `found`, roughly in
  //! the order of the patches. An image on a border may be found in both adjacent patches.
  void finish(std::vector<RoughImage>& found);

 private:
  using Pairs = std::vector<SearchedPair>;

  [[nodiscard]] PatchPairBatch batch_of(const Pairs& pairs) const;
  [[nodiscard]] Pairs& pairs_in(PatchShape shape) { return pairs_[static_cast<std::size_t>(shape)]; }
  void invert(const Pairs& pairs, PatchShape shape, std::vector<RoughImage>& found);
  void drop_outside(Pairs& pairs);
  void search_folded(const Pairs& pairs, std::vector<RoughImage>& found);
  void keep(const SearchedPair& pair, const FoldedRoot& root, std::vector<RoughImage>& found) const;

  const SearchInputs& inputs_;
  Pairs pairs_[3];  //!< by shape of patch
  Pairs undecided_;
  std::vector<int> stars_;  //!< buffer for a search of the field
  //! For each pair, whether the star is inside or outside the patch's border (PatchSide).
  std::vector<float> sides_;
  //! Results of the kernels for all pairs: whether a root was found, u, v and area.
  std::vector<float> roots_;
  FoldedSearch folded_search_;
};

//! Returns the number of parts in which find_rough_images() processes the patches.
int rough_parts(int patch_count);

//! Calls found(part, images) with the images in each part of the patches, concurrently from several
//! threads. `star_count`: number of stars in the field.
void find_rough_images(const SearchInputs& inputs, std::size_t star_count,
                       const std::function<void(int, const std::vector<RoughImage>&)>& found);

}  // namespace ergodome
