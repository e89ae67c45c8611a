#pragma once

#include <limits>

#include "kernels/core/shared_counter.h"
#include "kernels/stars/observed_positions_kernel.h"
#include "kernels/stars/search/part_halving_kernel.h"
#include "kernels/stars/search/part_solving_kernel.h"
#include "kernels/stars/search/patch_pairs_kernel.h"
#include "kernels/stars/search/patch_search.h"
#include "kernels/stars/search/search_steps.h"
#include "kernels/stars/search/star_bands_kernel.h"

// The launches of the search for images of stars on the GPU: each runs a step for one patch, pair
// or part per thread.
namespace ergodome::inline ERGO_TARGET {

namespace detail {
template <class T>
ERGO_HD void append(const SharedList<T>& list, const T& value) {
  const int at = count_up(list.count);
  if (at < list.room) {
    list.at[at] = value;
  }
}

ERGO_HD const SharedList<SearchedPair>& pairs_in(const PatchSearchBatch& batch, PatchShape shape) {
  return batch.pairs[static_cast<int>(shape)];
}

//! Returns whether a list has an element with this index.
template <class List>
ERGO_HD bool is_listed(const List& list, int index) {
  return index < *list.count && index < list.room;
}

//! Returns the parts of a list from index 0 up to and including `last`.
ERGO_HD SeenParts parts_to(const SharedParts& list, int last) { return {list.at, list.room, last + 1}; }

//! Keeps the image at a root of a pair's patch if it may be bright enough. Completes it if it needs
//! no rays.
ERGO_HD void keep_root(const PatchSearchBatch& batch, const SearchedPair& pair, const FoldedRoot& root) {
  RoughImage image{};
  if (!image_at_root(batch.inputs, pair, root, image)) {
    return;
  }
  if (!image.exact || !batch.completes) {
    return append(batch.images, image);
  }
  Vector3<float> direction{};
  float area = 0.0F;
  float frequency_ratio = 0.0F;
  const ObservedPositionBatch position = {batch.chart,
                                          batch.energy,
                                          batch.observer,
                                          1,
                                          &image.gamma_turns,
                                          &image.s,
                                          {&direction.x, &direction.y, &direction.z},
                                          &area,
                                          &frequency_ratio};
  ObservePositions<float>{position}(0);
  SeenImage found{};
  if (complete_image(batch.inputs.view, batch.colours, batch.appearance, pair.star, batch.inputs.field.stars[pair.star],
                     direction, frequency_ratio, image.sky / area, found)) {
    append(batch.exact, found);
  }
}
}  // namespace detail

//! Finds the stars that a patch may hold and that are bright enough. Index i is thread i %
//! patch_threads of side i / patch_threads; side j is side j % sides of patch j / sides.
struct FindPatchPairs {
  PatchSearchBatch batch;

  ERGO_HD void operator()(int index) const {
    const SearchInputs& inputs = batch.inputs;
    const int side = index / batch.patch_threads;
    const int number = side / inputs.sides;
    const bool mirrored = side % inputs.sides == 1;
    const StarPatch& patch = inputs.patches[number];
    if (may_be_seen(inputs.view, patch, mirrored)) {
      search_field<float>(inputs.field, turned(patch.part, inputs.turn, mirrored), floor_of(patch, inputs.faintest),
                          index % batch.patch_threads, batch.patch_threads, [&](int star) {
                            detail::append(detail::pairs_in(batch, patch.shape),
                                           pair_of(inputs, number, mirrored, star));
                          });
    }
  }
};

//! Seeks the star of pair i in its patch by Newton's method from the middle. Undecided pairs are
//! passed on to the search of folded patches.
template <PatchShape Shape>
struct InvertPair {
  PatchSearchBatch batch;

  ERGO_HD void operator()(int index) const {
    const SharedList<SearchedPair>& list = detail::pairs_in(batch, Shape);
    if (!detail::is_listed(list, index)) {
      return;
    }
    const PatchPairBatch pairs = {index + 1, list.at, batch.inputs.patches};
    auto side = PatchSide::inside;
    if constexpr (Shape == PatchShape::bent) {
      side = static_cast<PatchSide>(FindPatchSides<float>::sides(pairs, index));
      if (side == PatchSide::outside) {
        return;
      }
    }
    const PatchRoot<float> root = invert_patches<float>(pairs, index, newton_limits(Shape));
    switch (pair_result(Shape, side, root.found, root.at.u, root.at.v)) {
      case PairResult::image:
        return detail::keep_root(batch, list.at[index], {root.at.u, root.at.v, root.area});
      case PairResult::undecided:
        return detail::append(detail::pairs_in(batch, PatchShape::folded), list.at[index]);
      case PairResult::no_image:
        break;
    }
  }
};

//! Writes the patch of a folded pair, as its star sees it, to the first list of parts, and counts
//! it there. `index`: the pair within the slice.
struct SeeFoldedPair {
  PatchSearchBatch batch;

  ERGO_HD void operator()(int index) const {
    const SharedList<SearchedPair>& list = detail::pairs_in(batch, PatchShape::folded);
    if (!detail::is_listed(list, batch.first_folded + index)) {
      return;
    }
    const PatchPairBatch pairs = {index + 1, list.at + batch.first_folded, batch.inputs.patches};
    const SharedParts& to = batch.halved[0];
    // Indices within a slice are small enough to be exact in float.
    store_parts(whole_patches<float>(pairs, index),
                [&](int channel, float value) { to.at[static_cast<long>(channel) * to.room + index] = value; });
    count_up(to.count);
  }
};

//! Halves a part that has been halved `batch.depth` times, and drops halves whose control points
//! exclude the star.
struct HalveSeenPart {
  PatchSearchBatch batch;

  ERGO_HD void operator()(int index) const {
    const int depth = batch.depth;
    const SharedParts& from = batch.halved[depth % 2];
    if (!detail::is_listed(from, index)) {
      return;
    }
    const auto append = [&](PartList list, const SeenPart<float>& half, unsigned chosen) {
      if (chosen == 0) {
        return;
      }
      const SharedParts& to = list == to_halve        ? batch.halved[1 - depth % 2]
                              : list == regular_parts ? batch.regular_parts
                                                      : batch.folded_parts;
      const std::int32_t at = count_up(to.count);
      if (at >= to.room) {
        count_up(to.lost);
        return;
      }
      store_parts(half, [&](int channel, float value) { to.at[static_cast<long>(channel) * to.room + at] = value; });
    };
    halve_parts<float>(detail::parts_to(from, index), index, index + 1, depth, append);
  }
};

//! Returns whether an entry holds a root. Entries without one have an area of NaN.
ERGO_HD bool is_root(const FoldedRoot& root) { return root.area == root.area; }

//! Finds the roots of a part that is not to be halved, and counts them.
template <bool Folded>
struct SolveSeenPart {
  static constexpr int maximum = Folded ? max_part_roots : 1;
  PatchSearchBatch batch;

  ERGO_HD void operator()(int index) const {
    const SharedParts& from = Folded ? batch.folded_parts : batch.regular_parts;
    if (!detail::is_listed(from, index)) {
      return;
    }
    const PartRoots<float> solved = solve_parts<float>(detail::parts_to(from, index), index, Folded);
    FoldedRoot* const roots = (Folded ? batch.folded_roots : batch.regular_roots) + static_cast<long>(maximum) * index;
    const int pair = static_cast<int>(from.at[static_cast<long>(part_pair) * from.room + index]);
    for (int i = 0; i < maximum; ++i) {
      const PatchRoot<float>& root = solved.root[i];
      roots[i] = {root.at.u, root.at.v, root.found ? root.area : std::numeric_limits<float>::quiet_NaN()};
      if (is_root(roots[i])) {
        count_up(batch.root_counts + 2 * pair + (Folded ? 1 : 0));
      }
    }
  }
};

//! Appends the roots of a part to the list of its pair.
template <bool Folded>
struct ListRoots {
  PatchSearchBatch batch;

  ERGO_HD void operator()(int index) const {
    const SharedParts& from = Folded ? batch.folded_parts : batch.regular_parts;
    if (!detail::is_listed(from, index)) {
      return;
    }
    constexpr int maximum = SolveSeenPart<Folded>::maximum;
    const FoldedRoot* const roots =
        (Folded ? batch.folded_roots : batch.regular_roots) + static_cast<long>(maximum) * index;
    const int pair = static_cast<int>(from.at[static_cast<long>(part_pair) * from.room + index]);
    const int list = 2 * pair + (Folded ? 1 : 0);
    for (int i = 0; i < maximum; ++i) {
      if (is_root(roots[i])) {
        batch.roots[batch.root_first[list] + count_up(batch.root_counts + list)] = roots[i];
      }
    }
  }
};

//! Keeps each distinct root of pair `index`. Roots of regular parts come first, as in
//! FoldedSearch, since room for roots is limited.
struct TakeRoots {
  PatchSearchBatch batch;

  ERGO_HD void operator()(int index) const {
    const SharedList<SearchedPair>& list = detail::pairs_in(batch, PatchShape::folded);
    if (!detail::is_listed(list, batch.first_folded + index)) {
      return;
    }
    const SearchedPair pair = list.at[batch.first_folded + index];
    const int wanted = roots_wanted(batch.inputs.patches[pair.patch]);
    FoldedRoot taken[max_roots];
    int count = 0;
    for (int i = 2 * index; i < 2 * index + 2; ++i) {
      take(batch.roots + batch.root_first[i], batch.root_first[i + 1] - batch.root_first[i], wanted, taken, count);
    }
    for (int i = 0; i < count; ++i) {
      detail::keep_root(batch, pair, taken[i]);
    }
  }

 private:
  static ERGO_HD bool comes_before(const FoldedRoot& a, const FoldedRoot& b) {
    return a.u < b.u || (a.u == b.u && (a.v < b.v || (a.v == b.v && a.area < b.area)));
  }

  //! Takes roots in the order of their positions, since threads list them in nondeterministic
  //! order. Few of possibly hundreds are taken. A rejected root stays rejected, so each pass takes
  //! the next root that is accepted.
  ERGO_HD static void take(const FoldedRoot* listed, int listed_count, int wanted, FoldedRoot (&taken)[max_roots],
                           int& count) {
    const int before = count;
    bool more = true;
    while (more) {
      int next = -1;
      for (int i = 0; i < listed_count; ++i) {
        if ((count == before || comes_before(taken[count - 1], listed[i])) &&
            (next < 0 || comes_before(listed[i], listed[next])) && may_add_root(taken, count, wanted, listed[i])) {
          next = i;
        }
      }
      more = next >= 0;
      if (more) {
        taken[count++] = listed[next];
      }
    }
  }
};

template <class T, class Action>
void dispatch(const PatchSearchBatch& batch, const Action& action) {
  switch (batch.step) {
    case PatchSearchStep::find_pairs:
      return action(FindPatchPairs{batch});
    case PatchSearchStep::regular:
      return action(InvertPair<PatchShape::regular>{batch});
    case PatchSearchStep::bent:
      return action(InvertPair<PatchShape::bent>{batch});
    case PatchSearchStep::see_folded:
      return action(SeeFoldedPair{batch});
    case PatchSearchStep::halve:
      return action(HalveSeenPart{batch});
    case PatchSearchStep::solve_regular:
      return action(SolveSeenPart<false>{batch});
    case PatchSearchStep::solve_folded:
      return action(SolveSeenPart<true>{batch});
    case PatchSearchStep::list_regular:
      return action(ListRoots<false>{batch});
    case PatchSearchStep::list_folded:
      return action(ListRoots<true>{batch});
    case PatchSearchStep::take_roots:
      break;
  }
  action(TakeRoots{batch});
}

}  // namespace ergodome::inline ERGO_TARGET
