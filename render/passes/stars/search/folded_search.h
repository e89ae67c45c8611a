#pragma once

#include <memory>
#include <span>
#include <vector>

#include "kernels/stars/search/rough_image.h"
#include "kernels/stars/search/seen_parts.h"

namespace ergodome {

//! Finds all positions at which possibly folded patches contain stars, on the CPU. For each pair of
//! a patch and a star, the patch is halved as long as the control points of a part do not exclude
//! the star. The kernels process parts of many pairs together, depth first.
class FoldedSearch {
 public:
  //! Finds the roots of pairs: the positions in the patch at which the star is seen.
  void search(const PatchPairBatch& pairs);

  //! Returns the roots of a pair that the last search found.
  [[nodiscard]] std::span<const FoldedRoot> roots(std::size_t pair) const {
    return {roots_.data() + pair * max_roots, static_cast<std::size_t>(counts_[pair])};
  }

 private:
  //! A list of patch parts with its memory.
  struct Parts {
    std::unique_ptr<float[]> memory;
    SeenParts parts{};

    //! Makes room for `more` additional parts.
    void reserve(int more);
  };

  void search_some(const PatchPairBatch& pairs, std::size_t first);
  void halve(int depth);
  void solve(const Parts& leaves, bool folded, const PatchPairBatch& pairs, std::size_t first);

  std::vector<Parts> level_;  //!< parts by number of halvings
  Parts regular_;
  Parts folded_;
  std::vector<float> solved_;      //!< output of the kernel that finds the roots in parts
  std::vector<int> counts_;        //!< number of roots per pair
  std::vector<FoldedRoot> roots_;  //!< room for max_roots per pair
};

}  // namespace ergodome
