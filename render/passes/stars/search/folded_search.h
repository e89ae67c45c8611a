#pragma once

#include <span>
#include <vector>

#include "kernels/stars/search/rough_image.h"
#include "kernels/stars/search/seen_parts.h"

namespace ergodome {

//! What a search asks about a pair of a patch and a star.
struct FoldedPair {
  int halvings;  //!< see PartChannel
  float error;
  int roots_wanted;  //!< 1 where the patch is one to one
};

//! Finds all places at which patches that may be folded hold stars: patches are halved, each as one star sees it, where their control points
//! leave room for the star. Parts of many pairs go through the kernels together.
class FoldedSearch {
 public:
  //! Seeks the roots of pairs, for each of which something is `asked`.
  void search(const PatchPairBatch& pairs, std::span<const FoldedPair> asked);

  //! The roots that the last search has found for a pair.
  [[nodiscard]] std::span<const FoldedRoot> roots(std::size_t pair) const {
    return {roots_.data() + pair * most_roots, static_cast<std::size_t>(counts_[pair])};
  }

 private:
  //! Parts, and the memory they are in.
  struct PartList {
    std::vector<float> memory;
    SeenParts parts{};

    //! Room for `more` parts behind those that are there.
    void reserve(int more);
  };

  void search_some(const PatchPairBatch& pairs, std::span<const FoldedPair> asked, std::size_t first);
  void halve(int depth);
  void solve(PartList& leaves, bool folded, std::span<const FoldedPair> asked, std::size_t first);
  void add(std::size_t pair, const FoldedPair& asked, const FoldedRoot& root);

  std::vector<PartList> level_;  //!< parts by how often they have been halved
  PartList regular_;
  PartList folded_;
  std::vector<float> solved_;      //!< as kernels tell it
  std::vector<float> asked_;       //!< as they read it
  std::vector<int> counts_;        //!< of the roots of pairs
  std::vector<FoldedRoot> roots_;  //!< room for most_roots each
};

}  // namespace ergodome
