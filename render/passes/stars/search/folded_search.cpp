#include "render/passes/stars/search/folded_search.h"

#include <algorithm>
#include <cmath>

#include "kernels/launch/launch.h"
#include "kernels/stars/search/search_steps.h"

namespace ergodome {

namespace {

//! Number of parts that are halved as one block, before the resulting halves are: as many as fit
//! into the CPU's cache.
constexpr int block = 512;
//! Maximum number of pairs of a patch and a star that are searched together: enough to fill SIMD
//! lanes, but so few that floats represent their indices exactly.
constexpr std::size_t max_pairs = 1 << 16;

}  // namespace

void FoldedSearch::Parts::reserve(int more) {
  const int needed = parts.count + more + part_padding;
  if (needed <= parts.room) {
    return;
  }
  const int room = std::max(needed, 2 * parts.room);
  auto larger =
      std::make_unique_for_overwrite<float[]>(static_cast<std::size_t>(part_channels) * static_cast<std::size_t>(room));
  for (std::ptrdiff_t channel = 0; channel < part_channels; ++channel) {
    std::copy_n(memory.get() + channel * parts.room, parts.count, larger.get() + channel * room);
  }
  memory = std::move(larger);
  parts.at = memory.get();
  parts.room = room;
}

void FoldedSearch::search(const PatchPairBatch& pairs) {
  const auto count = static_cast<std::size_t>(pairs.count);
  counts_.assign(count, 0);
  roots_.resize(count * max_roots);
  for (std::size_t first = 0; first < count; first += max_pairs) {
    search_some({static_cast<int>(std::min(max_pairs, count - first)), pairs.pairs + first, pairs.patches}, first);
  }
}

void FoldedSearch::search_some(const PatchPairBatch& pairs, std::size_t first) {
  int deepest = 0;
  for (int i = 0; i < pairs.count; ++i) {
    deepest = std::max(deepest, pairs.patches[pairs.pairs[i].patch].halvings);
  }
  level_.resize(std::max(level_.size(), static_cast<std::size_t>(deepest) + 2));
  Parts& whole = level_[0];
  whole.parts.count = 0;
  whole.reserve(pairs.count);
  run_on_this_thread(SeePatchesBatch{pairs, whole.parts});
  whole.parts.count = pairs.count;
  regular_.parts.count = 0;
  folded_.parts.count = 0;
  halve(0);
  solve(regular_, false, pairs, first);
  solve(folded_, true, pairs, first);
}

void FoldedSearch::halve(int depth) {
  Parts& from = level_[static_cast<std::size_t>(depth)];
  Parts& to = level_[static_cast<std::size_t>(depth) + 1];
  for (int first = 0; first < from.parts.count; first += block) {
    const int last = std::min(first + block, from.parts.count);
    to.parts.count = 0;
    for (Parts* list : {&to, &regular_, &folded_}) {
      list->reserve(2 * (last - first));
    }
    run_on_this_thread(HalvePartsBatch{from.parts, first, last, depth, {&to.parts, &regular_.parts, &folded_.parts}});
    if (to.parts.count > 0) {
      halve(depth + 1);
    }
  }
}

void FoldedSearch::solve(const Parts& leaves, bool folded, const PatchPairBatch& pairs, std::size_t first) {
  const auto count = static_cast<std::size_t>(leaves.parts.count);
  if (count == 0) {
    return;
  }
  const std::size_t each = count * (folded ? max_part_roots : 1);
  solved_.resize(4 * each);
  float* const solved = solved_.data();
  run_on_this_thread(
      SolvePartsBatch{leaves.parts, folded, solved, solved + each, solved + 2 * each, solved + 3 * each});
  for (std::size_t i = 0; i < each; ++i) {
    if (solved[i] != 0.0F) {
      const auto pair =
          static_cast<std::size_t>(leaves.parts.at[part_pair * leaves.parts.room + static_cast<int>(i % count)]);
      const FoldedRoot root = {solved[each + i], solved[2 * each + i], solved[3 * each + i]};
      FoldedRoot* const roots = roots_.data() + (first + pair) * max_roots;
      int& root_count = counts_[first + pair];
      if (may_add_root(roots, root_count, roots_wanted(pairs.patches[pairs.pairs[pair].patch]), root)) {
        roots[root_count++] = root;
      }
    }
  }
}

}  // namespace ergodome
