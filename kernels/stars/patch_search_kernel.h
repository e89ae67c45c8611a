#pragma once

#include "kernels/core/arithmetic.h"
#include "kernels/core/shared_counter.h"
#include "kernels/stars/part_halving_kernel.h"
#include "kernels/stars/part_solving_kernel.h"
#include "kernels/stars/patch_search.h"
#include "kernels/stars/search_rules.h"

namespace ergodome::inline ERGO_TARGET {

namespace detail {
template <class T>
ERGO_HD void append(const SharedList<T>& list, const T& value) {
  const int at = count_up(list.count);
  if (at < list.room) {
    list.at[at] = value;
  }
}

//! A star as patches see it, which belong to a camera at φ = 0, and to one half of a mirrored sky.
ERGO_HD Vector3<double> as_patches_see(const PatchSearchBatch& batch, const Vector3<double>& d, bool mirrored) {
  return {batch.cosine_phi * d.x + batch.sine_phi * d.y, batch.cosine_phi * d.y - batch.sine_phi * d.x,
          mirrored ? -d.z : d.z};
}
}  // namespace detail

//! Finds the stars that a patch may hold, and that are bright enough; index i is side i % sides of patch i / sides.
struct FindPatchPairs {
  PatchSearchBatch batch;

  ERGO_HD void operator()(int index) const {
    const int number = index / batch.sides;
    const bool mirrored = index % batch.sides == 1;
    const StarPatch& patch = batch.patches[number];
    if (!may_be_seen(patch, mirrored)) {
      return;
    }
    const SearchedField& field = batch.field;
    const float floor = batch.faintest / (patch.light.brighter * patch.magnification);
    const ShiftGain& gain = field.gains[patch.light.shift_row];
    const float faintest = floor / field.greatest_gain[patch.light.shift_row];
    const StarLevel& level = level_for(faintest);
    const SkyPart part = turned(patch.part, batch.turn, mirrored);
    const CellRange range = cells_of(part.bounds, level.stars);
    const int end_cell = range.first_cell + range.cell_count;
    const auto search = [&](int first, int last) {
      for (int at = first; at < last; ++at) {
        if (level.stars.illuminance[at] >= faintest && is_within(part, level.stars, at) &&
            level.stars.illuminance[at] * gain.gain[level.colour[at]] >= floor) {
          add(patch, number, mirrored, level.number[at]);
        }
      }
    };
    for (int band = range.first_band; band < range.last_band; ++band) {
      const int* const first = level.stars.first + static_cast<long>(band) * level.stars.cells;
      if (end_cell <= level.stars.cells) {
        search(first[range.first_cell], first[end_cell]);
      } else {
        search(first[range.first_cell], first[level.stars.cells]);
        search(first[0], first[end_cell - level.stars.cells]);
      }
    }
  }

 private:
  [[nodiscard]] ERGO_HD bool may_be_seen(const StarPatch& patch, bool mirrored) const {
    const Vector3<double> way = {static_cast<double>(patch.seen.x),
                                 static_cast<double>(mirrored ? -patch.seen.y : patch.seen.y),
                                 static_cast<double>(patch.seen.z)};
    return cone_may_touch(batch.view_axis, batch.view_half_angle, batch.view_cosine, way,
                          static_cast<double>(patch.seen_radius));
  }

  //! The fewest stars among which all are that have so much light.
  [[nodiscard]] ERGO_HD const StarLevel& level_for(float faintest) const {
    for (int i = batch.field.level_count - 1; i > 0; --i) {
      if (batch.field.levels[i].left_out < faintest) {
        return batch.field.levels[i];
      }
    }
    return batch.field.levels[0];
  }

  static ERGO_HD bool is_within(const SkyPart& part, const StarBands& stars, int at) {
    bool held = true;
    for (const auto& inward : part.inward) {
      held = held && inward[0] * stars.direction[0][at] + inward[1] * stars.direction[1][at] +
                             inward[2] * stars.direction[2][at] >=
                         0.0F;
    }
    return held;
  }

  ERGO_HD void add(const StarPatch& patch, int number, bool mirrored, int star) const {
    const Vector3<double> d = detail::as_patches_see(batch, batch.field.stars[star].direction, mirrored);
    const double depth = dot(d, patch.frame.axis);
    detail::append(batch.pairs[static_cast<int>(patch.shape)],
                   {number, star, static_cast<float>(depth), static_cast<float>(dot(d, patch.frame.first) / depth),
                    static_cast<float>(dot(d, patch.frame.second) / depth), mirrored});
  }
};

//! Keeps the image that a root of a pair's patch is, if it may be bright enough.
ERGO_HD void keep_root(const PatchSearchBatch& batch, const SearchedPair& pair, const FoldedRoot& root) {
  const StarPatch& patch = batch.patches[pair.patch];
  const FieldStar& star = batch.field.stars[pair.star];
  const float sky = sky_of_root(root.area, pair.depth);
  const ShiftGain& shift = batch.field.gains[patch.light.shift_row];
  const float gain = most_gain(patch, sky) * shift.gain[star_class(star.log_temperature)];
  if (!(star.illuminance * gain >= batch.faintest)) {
    return;
  }
  ChartImage image = chart_image(patch, root, sky);
  bool exact = false;
  if (patch.exact && patch.shape != PatchShape::folded) {
    const Vector3<double> d = detail::as_patches_see(batch, star.direction, pair.mirrored);
    exact = mend_image(batch.mended, patch.leaf,
                       {static_cast<float>(d.x), static_cast<float>(d.y), static_cast<float>(d.z)}, image);
  }
  const float seen = pair.mirrored ? 1.0F - image.gamma_turns : image.gamma_turns;
  detail::append(batch.images,
                 {pair.star, seen - ::floorf(seen), image.s, image.sky, patch.brighter, exact, root.area == 0.0F});
}

//! Seeks the star of pair i in its patch, by Newton's method from the middle; bent patches that do not tell are left to the search of folded ones.
template <PatchShape Shape>
struct InvertPair {
  PatchSearchBatch batch;

  ERGO_HD void operator()(int index) const {
    const SearchedPair pair = batch.pairs[static_cast<int>(Shape)].at[index];
    const BezierPatch* const sky = &batch.patches[pair.patch].sky;
    const PatchPairBatch one = {1, &sky, &pair.a, &pair.b};
    float side = 0.0F;
    if constexpr (Shape == PatchShape::bent) {
      const PatchSideBatch sides = {one, &side};
      FindPatchSides<float>{sides}(0);
      if (side == static_cast<float>(PatchSide::outside)) {
        return;
      }
    }
    float found = 0.0F;
    FoldedRoot root{};
    const bool regular = Shape == PatchShape::regular;
    const PatchNewtonBatch newton = {one,
                                     regular ? farthest_regular : any_step,
                                     regular ? rounds_regular : rounds_bent,
                                     &found,
                                     &root.u,
                                     &root.v,
                                     &root.area};
    InvertPatches<float>{newton}(0);
    const PatchPlace<float> place = {root.u, root.v};
    if (found != 0.0F && within_patch(place, beyond_patch)) {
      keep_root(batch, pair, root);
    } else if (!regular &&
               (side == static_cast<float>(PatchSide::inside) || found == 0.0F || !within_patch(place, near_outside))) {
      detail::append(batch.pairs[static_cast<int>(PatchShape::folded)], pair);
    }
  }
};

//! Seeks all places at which the patch of pair i, which may be folded, holds its star: FoldedSearch (render/stars/folded_search.h), one pair a thread.
struct SearchFoldedPair {
  PatchSearchBatch batch;

  ERGO_HD void operator()(int index) const {
    const SearchedPair pair = batch.pairs[static_cast<int>(PatchShape::folded)].at[index];
    const StarPatch& patch = batch.patches[pair.patch];
    Search search(patch, pair);
    // What is nearly affine first, as elsewhere: room for roots is short.
    search.go(false);
    if (search.has_folded) {
      search.go(true);
    }
    for (int i = 0; i < search.root_count; ++i) {
      keep_root(batch, pair, search.roots[i]);
    }
  }

 private:
  //! Halvings of a patch at the most.
  static constexpr int deepest = 24;

  //! A list of two parts.
  struct TwoParts {
    float memory[2 * part_channels];
    [[nodiscard]] ERGO_HD SeenParts parts(int count) { return {memory, 2, count}; }
  };

  struct Search {
    TwoParts level[deepest];
    int count[deepest];
    int next[deepest];
    FoldedRoot roots[most_roots];
    int root_count = 0;
    int wanted;
    bool has_folded = false;

    ERGO_HD Search(const StarPatch& patch, const SearchedPair& pair)
        : wanted(patch.shape == PatchShape::bent ? 1 : most_roots) {
      const BezierPatch* const sky = &patch.sky;
      const auto halvings = static_cast<float>(patch.halvings < deepest - 1 ? patch.halvings : deepest - 1);
      const PatchPairBatch one = {1, &sky, &pair.a, &pair.b};
      const SeePatchesBatch see = {one, &patch.error, &halvings, level[0].parts(0)};
      SeePatches<float>{see}(0);
    }

    //! Halves the patch where its control points leave room for the star, the first half before the second; solves the parts that are nearly
    //! affine, or those that may be folded.
    ERGO_HD void go(bool folded) {
      int depth = 0;
      count[0] = 1;
      next[0] = 0;
      while (depth >= 0 && root_count < wanted) {
        if (next[depth] == count[depth]) {
          --depth;
          continue;
        }
        const int part = next[depth]++;
        TwoParts solvable[2];
        SeenParts halves = level[depth + 1].parts(0);
        SeenParts regular = solvable[0].parts(0);
        SeenParts bent = solvable[1].parts(0);
        const HalvePartsBatch halve = {
            level[depth].parts(count[depth]), part, part + 1, depth, &halves, &regular, &bent};
        HalveParts<float>{halve}(0);
        has_folded = has_folded || bent.count > 0;
        solve(folded ? bent : regular, folded);
        if (halves.count > 0) {
          ++depth;
          count[depth] = halves.count;
          next[depth] = 0;
        }
      }
    }

    ERGO_HD void solve(const SeenParts& parts, bool folded) {
      if (parts.count == 0) {
        return;
      }
      constexpr int most = 2 * most_part_roots;
      float found[most] = {};
      float u[most];
      float v[most];
      float area[most];
      const SolvePartsBatch batch = {parts, folded, found, u, v, area};
      const SolveParts<float> solve_part{batch};
      for (int i = 0; i < parts.count; ++i) {
        solve_part(i);
      }
      for (int i = 0; i < parts.count * (folded ? most_part_roots : 1); ++i) {
        if (found[i] != 0.0F) {
          add({u[i], v[i], area[i]});
        }
      }
    }

    ERGO_HD void add(const FoldedRoot& root) {
      if (may_add_root(roots, root_count, wanted, root)) {
        roots[root_count++] = root;
      }
    }
  };
};

}  // namespace ergodome::inline ERGO_TARGET
