#pragma once

#include <limits>

#include "kernels/core/arithmetic.h"
#include "kernels/core/shared_counter.h"
#include "kernels/core/sort_in_place.h"
#include "kernels/stars/observed_places_kernel.h"
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
//! Sees an image that needs no rays as its observer does.
ERGO_HD void judge(const PatchSearchBatch& batch, int number, const FieldStar& star, const ChartImage& image) {
  Vector3<float> direction{};
  float area = 0.0F;
  float frequency_ratio = 0.0F;
  const ObservedPlaceBatch place = {batch.chart,
                                    batch.energy,
                                    batch.observer,
                                    1,
                                    &image.gamma_turns,
                                    &image.s,
                                    {&direction.x, &direction.y, &direction.z},
                                    &area,
                                    &frequency_ratio};
  ObservePlaces<float>{place}(0);
  const Vector3<double> way = {static_cast<double>(direction.x), static_cast<double>(direction.y),
                               static_cast<double>(direction.z)};
  SeenImage found{};
  if (cone_may_touch(batch.view_axis, batch.view_half_angle, batch.view_cosine, way, 0.0) &&
      exact_image(batch.colours, batch.look, number, star, direction, frequency_ratio, image.sky / area, found)) {
    append(batch.exact, found);
  }
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
  image.gamma_turns = seen - ::floorf(seen);
  if (exact && batch.judges) {
    detail::judge(batch, pair.star, star, image);
  } else {
    detail::append(batch.images,
                   {pair.star, image.gamma_turns, image.s, image.sky, patch.brighter, exact, root.area == 0.0F});
  }
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

namespace detail {
ERGO_HD const SearchedPair& folded_pair(const PatchSearchBatch& batch, int index) {
  return batch.pairs[static_cast<int>(PatchShape::folded)].at[batch.first_folded + index];
}
}  // namespace detail

//! Shows the patch of a pair of the slice, which may be folded, as its star sees it: part i of the first list.
struct SeeFoldedPair {
  PatchSearchBatch batch;

  ERGO_HD void operator()(int index) const {
    const SearchedPair pair = detail::folded_pair(batch, index);
    const StarPatch& patch = batch.patches[pair.patch];
    const BezierPatch* const sky = &patch.sky;
    const auto halvings = static_cast<float>(patch.halvings);
    const PatchPairBatch one = {1, &sky, &pair.a, &pair.b};
    const SharedParts& to = batch.halved[0];
    const SeePatchesBatch see = {one, &patch.error, &halvings, {to.at + index, to.room, 0}};
    SeePatches<float>{see}(0);
    // Numbers in a slice are exact in float.
    to.at[static_cast<long>(part_pair) * to.room + index] = static_cast<float>(index);
  }
};

//! Halves a part of those that have been halved `depth` times where its control points leave room for the star.
struct HalveSeenPart {
  PatchSearchBatch batch;
  int depth;

  ERGO_HD void operator()(int index) const {
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

//! Whether a part has told a root, and not that it has none.
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

//! Tells a pair the roots of a part.
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

//! Keeps the roots of pair i, each once; what is nearly affine first, as FoldedSearch does, since room for roots is short.
struct TakeRoots {
  PatchSearchBatch batch;

  ERGO_HD void operator()(int index) const {
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
  //! In the order of their places, as chance told them in another each time.
  ERGO_HD static void take(FoldedRoot* told, int told_count, int wanted, FoldedRoot (&taken)[most_roots], int& count) {
    sort_in_place(told, told_count,
                  [](const FoldedRoot& a, const FoldedRoot& b) { return a.u < b.u || (a.u == b.u && a.v < b.v); });
    for (int i = 0; i < told_count; ++i) {
      if (may_add_root(taken, count, wanted, told[i])) {
        taken[count++] = told[i];
      }
    }
  }
};

//! Calls action(functor) with what a step does; `depth`: of the parts to be halved.
template <class Action>
inline void with_search_step(const PatchSearchBatch& batch, PatchSearchStep step, int depth, const Action& action) {
  switch (step) {
    case PatchSearchStep::find_pairs:
      return action(FindPatchPairs{batch});
    case PatchSearchStep::regular:
      return action(InvertPair<PatchShape::regular>{batch});
    case PatchSearchStep::bent:
      return action(InvertPair<PatchShape::bent>{batch});
    case PatchSearchStep::see_folded:
      return action(SeeFoldedPair{batch});
    case PatchSearchStep::halve:
      return action(HalveSeenPart{batch, depth});
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
