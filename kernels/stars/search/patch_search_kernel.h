#pragma once

#include "kernels/stars/search/folded_pairs_kernel.h"
#include "kernels/stars/search/keep_root.h"
#include "kernels/stars/search/patch_pairs_kernel.h"

// The steps of the search for images of stars on the GPU.
namespace ergodome::inline ERGO_TARGET {

//! Finds the stars that a patch may hold and that are bright enough. Index i is thread i %
//! patch_threads of side i / patch_threads; side j is side j % sides of patch j / sides.
struct FindPatchPairs {
  PatchSearchBatch batch;

  ERGO_HD void operator()(int index) const {
    const int side = index / batch.patch_threads;
    const int thread = index % batch.patch_threads;
    const int number = side / batch.sides;
    const bool mirrored = side % batch.sides == 1;
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
      for (int at = first + thread; at < last; at += batch.patch_threads) {
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

  //! Returns the smallest level that contains all stars of at least this illuminance.
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

//! Seeks the star of pair i in its patch by Newton's method from the middle. Undecided pairs of
//! bent patches are left to the search of folded ones.
template <PatchShape Shape>
struct InvertPair {
  PatchSearchBatch batch;

  ERGO_HD void operator()(int index) const {
    const SharedList<SearchedPair>& pairs = batch.pairs[static_cast<int>(Shape)];
    if (index >= *pairs.count || index >= pairs.room) {
      return;
    }
    const SearchedPair pair = pairs.at[index];
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
    case PatchSearchStep::solve_plain:
      return action(SolveSeenPart<false>{batch});
    case PatchSearchStep::solve_folded:
      return action(SolveSeenPart<true>{batch});
    case PatchSearchStep::tell_plain:
      return action(TellRoots<false>{batch});
    case PatchSearchStep::tell_folded:
      return action(TellRoots<true>{batch});
    case PatchSearchStep::take_roots:
      break;
  }
  action(TakeRoots{batch});
}

}  // namespace ergodome::inline ERGO_TARGET
