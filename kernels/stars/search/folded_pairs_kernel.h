#pragma once

#include <limits>

#include "kernels/stars/search/keep_root.h"
#include "kernels/stars/search/part_halving_kernel.h"
#include "kernels/stars/search/part_solving_kernel.h"

// Finds all images of stars in patches that may be folded, one part per thread, on the GPU. On the
// CPU, FoldedSearch (render/passes/stars/search/folded_search.h) works on packs of parts.
namespace ergodome::inline ERGO_TARGET {

namespace detail {
ERGO_HD const SearchedPair& folded_pair(const PatchSearchBatch& batch, int index) {
  return batch.pairs[static_cast<int>(PatchShape::folded)].at[batch.first_folded + index];
}

//! Returns whether the slice has a pair with this index.
ERGO_HD bool is_in_slice(const PatchSearchBatch& batch, int index) {
  const SharedList<SearchedPair>& pairs = batch.pairs[static_cast<int>(PatchShape::folded)];
  const int at = batch.first_folded + index;
  return at < *pairs.count && at < pairs.room;
}
}  // namespace detail

//! Writes the patch of a folded pair, as its star sees it, to the first list of parts, and counts
//! it there. `index`: the pair within the slice.
struct SeeFoldedPair {
  PatchSearchBatch batch;

  ERGO_HD void operator()(int index) const {
    if (!detail::is_in_slice(batch, index)) {
      return;
    }
    const SearchedPair pair = detail::folded_pair(batch, index);
    const StarPatch& patch = batch.patches[pair.patch];
    const BezierPatch* const sky = &patch.sky;
    const auto halvings = static_cast<float>(patch.halvings);
    const PatchPairBatch one = {1, &sky, &pair.a, &pair.b};
    const SharedParts& to = batch.halved[0];
    const SeePatchesBatch see = {one, &patch.error, &halvings, {to.at + index, to.room, 0}};
    SeePatches<float>{see}(0);
    // Indices within a slice are small enough to be exact in float.
    to.at[static_cast<long>(part_pair) * to.room + index] = static_cast<float>(index);
    count_up(to.count);
  }
};

//! Halves a part that has been halved `batch.depth` times, and drops halves whose control points exclude
//! the star.
struct HalveSeenPart {
  PatchSearchBatch batch;

  ERGO_HD void operator()(int index) const {
    const int depth = batch.depth;
    const SharedParts& from = batch.halved[depth % 2];
    if (index >= *from.count || index >= from.room) {
      return;
    }
    TwoParts memory[3];
    SeenParts lists[3];
    for (int i = 0; i < 3; ++i) {
      lists[i] = {memory[i].at, 2, 0};
    }
    const HalvePartsBatch halve = {{from.at + index, from.room, 1}, 0, 1, depth, &lists[0], &lists[1], &lists[2]};
    HalveParts<float>{halve}(0);
    append(lists[0], batch.halved[1 - depth % 2]);
    append(lists[1], batch.plain_parts);
    append(lists[2], batch.folded_parts);
  }

 private:
  struct TwoParts {
    float at[2 * part_channels];
  };

  ERGO_HD static void append(const SeenParts& parts, const SharedParts& to) {
    for (int i = 0; i < parts.count; ++i) {
      const std::int32_t place = count_up(to.count);
      if (place >= to.room) {
        count_up(to.lost);
        continue;
      }
      for (int channel = 0; channel < part_channels; ++channel) {
        to.at[static_cast<long>(channel) * to.room + place] = parts.at[channel * parts.room + i];
      }
    }
  }
};

//! Returns whether an entry holds a root. Entries without one have an area of NaN.
ERGO_HD bool is_root(const FoldedRoot& root) { return root.area == root.area; }

//! Finds the roots of a part that is not to be halved, and counts them.
template <bool Folded>
struct SolveSeenPart {
  static constexpr int most = Folded ? most_part_roots : 1;
  PatchSearchBatch batch;

  ERGO_HD void operator()(int index) const {
    const SharedParts& from = Folded ? batch.folded_parts : batch.plain_parts;
    if (index >= *from.count || index >= from.room) {
      return;
    }
    float found[most_part_roots] = {};
    float u[most_part_roots];
    float v[most_part_roots];
    float area[most_part_roots];
    const SolvePartsBatch solve = {{from.at + index, from.room, 1}, Folded, found, u, v, area};
    SolveParts<float>{solve}(0);
    FoldedRoot* const roots = (Folded ? batch.folded_roots : batch.plain_roots) + static_cast<long>(most) * index;
    const int pair = static_cast<int>(from.at[static_cast<long>(part_pair) * from.room + index]);
    for (int i = 0; i < most; ++i) {
      roots[i] = {u[i], v[i], found[i] != 0.0F ? area[i] : std::numeric_limits<float>::quiet_NaN()};
      if (is_root(roots[i])) {
        count_up(batch.told_counts + 2 * pair + (Folded ? 1 : 0));
      }
    }
  }
};

//! Lists the roots of a part for its pair.
template <bool Folded>
struct TellRoots {
  PatchSearchBatch batch;

  ERGO_HD void operator()(int index) const {
    const SharedParts& from = Folded ? batch.folded_parts : batch.plain_parts;
    if (index >= *from.count || index >= from.room) {
      return;
    }
    constexpr int most = SolveSeenPart<Folded>::most;
    const FoldedRoot* const roots = (Folded ? batch.folded_roots : batch.plain_roots) + static_cast<long>(most) * index;
    const int pair = static_cast<int>(from.at[static_cast<long>(part_pair) * from.room + index]);
    const int list = 2 * pair + (Folded ? 1 : 0);
    for (int i = 0; i < most; ++i) {
      if (is_root(roots[i])) {
        batch.told[batch.told_first[list] + count_up(batch.told_counts + list)] = roots[i];
      }
    }
  }
};

//! Keeps each distinct root of pair `index`. Roots of nearly affine parts come first, as in
//! FoldedSearch, since room for roots is limited.
struct TakeRoots {
  PatchSearchBatch batch;

  ERGO_HD void operator()(int index) const {
    if (!detail::is_in_slice(batch, index)) {
      return;
    }
    const SearchedPair pair = detail::folded_pair(batch, index);
    const int wanted = batch.patches[pair.patch].shape == PatchShape::bent ? 1 : most_roots;
    FoldedRoot taken[most_roots];
    int count = 0;
    for (int list = 2 * index; list < 2 * index + 2; ++list) {
      take(batch.told + batch.told_first[list], batch.told_first[list + 1] - batch.told_first[list], wanted, taken,
           count);
    }
    for (int i = 0; i < count; ++i) {
      keep_root(batch, pair, taken[i]);
    }
  }

 private:
  static ERGO_HD bool comes_before(const FoldedRoot& a, const FoldedRoot& b) {
    return a.u < b.u || (a.u == b.u && (a.v < b.v || (a.v == b.v && a.area < b.area)));
  }

  //! Takes roots in the order of their positions, since threads list them in nondeterministic
  //! order. Few of possibly hundreds are taken. A rejected root stays rejected, so each pass takes
  //! the next root that is accepted.
  ERGO_HD static void take(const FoldedRoot* told, int told_count, int wanted, FoldedRoot (&taken)[most_roots],
                           int& count) {
    const int before = count;
    bool more = true;
    while (more) {
      int next = -1;
      for (int i = 0; i < told_count; ++i) {
        if ((count == before || comes_before(taken[count - 1], told[i])) &&
            (next < 0 || comes_before(told[i], told[next])) && may_add_root(taken, count, wanted, told[i])) {
          next = i;
        }
      }
      more = next >= 0;
      if (more) {
        taken[count++] = told[next];
      }
    }
  }
};

}  // namespace ergodome::inline ERGO_TARGET
