#pragma once

#include <span>
#include <vector>

#include "kernels/stars/search/rough_image.h"
#include "kernels/stars/search/seen_parts.h"

namespace ergodome {

//! Search parameters of a (patch, star) pair.
struct FoldedPair {
  int halvings;  //!< see PartChannel
  float error;
  int roots_wanted;  //!< 1 if the patch is one to one
};

//! Finds all positions at which possibly folded patches contain stars. Patches, as seen from one
//! star each, are halved for as long as their control points leave room for the star. The kernels
//! process parts of many pairs together.
class FoldedSearch {
 public:
  //! Finds the roots of pairs; `asked` holds the parameters of each.
  void search(const PatchPairBatch& pairs, std::span<const FoldedPair> asked);

  //! Returns the roots of a pair that the last search found.
  [[nodiscard]] std::span<const FoldedRoot> roots(std::size_t pair) const {
    return {roots_.data() + pair * most_roots, static_cast<std::size_t>(counts_[pair])};
  }

 private:
  //! A list of patch parts with its memory.
  struct PartList {
    std::vector<float> memory;
    SeenParts parts{};

    //! Makes room for `more` additional parts.
    void reserve(int more);
  };

  void search_some(const PatchPairBatch& pairs, std::span<const FoldedPair> asked, std::size_t first);
  void halve(int depth);
  void solve(PartList& leaves, bool folded, std::span<const FoldedPair> asked, std::size_t first);
  void add(std::size_t pair, const FoldedPair& asked, const FoldedRoot& root);

  std::vector<PartList> level_;  //!< parts by number of halvings
  PartList regular_;
  PartList folded_;
  std::vector<float> solved_;      //!< output of the kernels
  std::vector<float> asked_;       //!< input of the kernels
  std::vector<int> counts_;        //!< number of roots per pair
  std::vector<FoldedRoot> roots_;  //!< room for most_roots per pair
};

}  // namespace ergodome
