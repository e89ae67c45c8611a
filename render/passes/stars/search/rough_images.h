#pragma once

#include <functional>
#include <vector>

#include "kernels/stars/search/patch_pairs.h"
#include "kernels/stars/search/rough_image.h"
#include "render/passes/stars/search/folded_search.h"
#include "render/passes/stars/search/star_patches.h"
#include "render/passes/stars/search/view_cone.h"

namespace ergodome {

//! Finds the images in patches that may be bright enough. Collects the stars of many patches,
//! because kernels use many lanes and a patch has only a few stars.
class RoughImageFinder {
 public:
  //! `phi`: azimuth of the camera [rad]. The arguments must outlive the finder.
  RoughImageFinder(const StarPatches& patches, const StarField& field, double phi);

  //! Collects the stars of a patch, or with `mirrored` those of its mirror image in the other half
  //! of the sky.
  void look_in(const StarPatch& patch, bool mirrored);

  //! Appends the images in the patches collected so far to `found`, roughly in the order of the
  //! patches. An image on a border may be found from both sides.
  void finish(std::vector<RoughImage>& found);

 private:
  //! A star that a patch may contain.
  struct Pair {
    const StarPatch* patch;
    bool mirrored;
    int star;     //!< index in the field
    float depth;  //!< cosine of the angle to the patch's axis
  };

  //! Pairs in the layout that kernels read.
  struct PairList {
    std::vector<Pair> pairs;
    std::vector<const BezierPatch*> patch;
    std::vector<float> a;
    std::vector<float> b;

    void add(const Pair& pair, float at_a, float at_b);
    void clear();
    [[nodiscard]] PatchPairBatch batch() const;
  };

  //! Returns the star's direction relative to a camera at φ = 0 and to the unmirrored half of the
  //! sky.
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
  PairList folded_;           //!< in patches that may be folded
  std::vector<int> stars_;    //!< buffer for a search of the field
  std::vector<float> sides_;  //!< side of the patch border on which each star lies
  std::vector<float> roots_;  //!< found, u, v and area for all pairs
  FoldedSearch folded_search_;
  std::vector<FoldedPair> asked_;
};

//! Returns the number of parts in which find_rough_images() processes the patches.
int rough_parts(const StarPatches& patches);

//! Calls found(part, images) with the images in each part of the patches, concurrently from several
//! threads. `phi`: azimuth of the camera [rad].
void find_rough_images(const StarField& field, double phi, const StarPatches& patches, const ViewCone& view,
                       const std::function<void(int, const std::vector<RoughImage>&)>& found);

}  // namespace ergodome
