#pragma once

#include <functional>
#include <vector>

#include "kernels/stars/search/patch_pairs.h"
#include "kernels/stars/search/rough_image.h"
#include "render/passes/stars/search/folded_search.h"
#include "render/passes/stars/search/star_patches.h"
#include "render/passes/stars/search/view_cone.h"

namespace ergodome {

//! Finds the images that patches hold and that may be bright enough. Stars of many patches are sought at once, as kernels work on many
//! lanes and a patch has but a few stars.
class RoughImageFinder {
 public:
  //! The camera is at `phi` [rad]. All that is given has to outlive the finder.
  RoughImageFinder(const StarPatches& patches, const StarField& field, double phi);

  //! Takes a patch, or with `mirrored` its image in the other half of a mirrored sky.
  void look_in(const StarPatch& patch, bool mirrored);

  //! Adds the images in what was taken so far to `found`, roughly in the order of the patches. An image on a border may be found from
  //! both sides.
  void finish(std::vector<RoughImage>& found);

 private:
  //! A star that a patch may hold.
  struct Pair {
    const StarPatch* patch;
    bool mirrored;
    int star;     //!< in the field
    float depth;  //!< cosine of the angle to the patch's axis
  };

  //! Pairs as kernels read them.
  struct PairList {
    std::vector<Pair> pairs;
    std::vector<const BezierPatch*> patch;
    std::vector<float> a;
    std::vector<float> b;

    void add(const Pair& pair, float at_a, float at_b);
    void clear();
    [[nodiscard]] PatchPairBatch batch() const;
  };

  //! Patches belong to a camera at φ = 0, and to one half of a mirrored sky.
  [[nodiscard]] Vector3<double> as_patches_see(const FieldStar& star, bool mirrored) const;

  void invert(const PairList& list, float farthest, int rounds);
  [[nodiscard]] bool within(std::size_t pair) const;
  void finish_regular(std::vector<RoughImage>& found);
  void finish_bent(std::vector<RoughImage>& found);
  void search_folded(const PairList& list, std::vector<RoughImage>& found);
  void keep(const Pair& pair, const FoldedRoot& root, std::vector<RoughImage>& found) const;

  const StarPatches& patches_;
  const StarField& field_;
  SkyTurn turn_;
  double sine_phi_;
  double cosine_phi_;
  PairList regular_;
  PairList bent_;
  PairList folded_;           //!< in patches that may be
  std::vector<int> stars_;    //!< room for a search of the field
  std::vector<float> sides_;  //!< of the patches' borders that stars are on
  std::vector<float> roots_;  //!< found, u, v and area of all pairs
  FoldedSearch folded_search_;
  std::vector<FoldedPair> asked_;
};

//! The parts in which find_rough_images() takes patches.
int rough_parts(const StarPatches& patches);

//! Calls found(part, images) with the images that each part of the patches holds; parts on many threads at once. The camera is at `phi` [rad].
void find_rough_images(const StarField& field, double phi, const StarPatches& patches, const ViewCone& view,
                       const std::function<void(int, const std::vector<RoughImage>&)>& found);

}  // namespace ergodome
