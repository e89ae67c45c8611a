#pragma once

#include "kernels/core/lanes.h"
#include "kernels/stars/search/patch_pairs_kernel.h"

// Halves parts of patches until Newton's method is safe in each; see seen_parts.h.
namespace ergodome::inline ERGO_TARGET {

namespace detail {
//! Returns the size of a part along u (axis 0) or v (axis 1) after `depth` halvings, as a fraction
//! of the patch.
ERGO_HD float part_size(int axis, int depth) {
  return 1.0F / static_cast<float>(1U << static_cast<unsigned>((depth + 1 - axis) / 2));
}

//! Computes approximately the direction along which each part is longest in the plane of p and q,
//! as a unit vector (x, y). Returns the lengths of the parts along these directions.
template <class T>
ERGO_HD T long_way(const SeenPatch<T>& part, T& x, T& y) {
  const auto from_to = [](const T(&at)[16], int a, int b, int c, int d) {
    return T(0.5F) * (at[b] + at[d] - at[a] - at[c]);
  };
  const T along_x = from_to(part.p, 0, 3, 12, 15);
  const T along_y = from_to(part.q, 0, 3, 12, 15);
  const T across_x = from_to(part.p, 0, 12, 3, 15);
  const T across_y = from_to(part.q, 0, 12, 3, 15);
  const T along = along_x * along_x + along_y * along_y;
  const T across = across_x * across_x + across_y * across_y;
  const MaskOf<T> first = along > across;
  const T length = sqrt(maximum(along, across));
  const MaskOf<T> some = length > T(1e-15F);
  const T inverse = select(some, T(1.0F) / length, T(0.0F));
  x = select(some, select(first, along_x, across_x) * inverse, T(1.0F));
  y = select(first, along_y, across_y) * inverse;
  return length;
}

//! Returns the lanes whose star lies within a bounding box of the control points. The box is
//! aligned with the part, since parts of a bent patch are slivers in any direction.
template <class T>
ERGO_HD MaskOf<T> may_hold_star(const SeenPatch<T>& part, const T& error) {
  T x;
  T y;
  const T length = long_way(part, x, y);
  // The slack ensures that, in spite of rounding, a root on a border between two parts belongs to
  // both.
  const T slack = T(1e-3F) * length + error;
  const auto has_both_signs = [&](const T& of_p, const T& of_q) {
    T low = of_p * part.p[0] + of_q * part.q[0];
    T high = low;
    ERGO_UNROLL
    for (int i = 1; i < 16; ++i) {
      const T at = of_p * part.p[i] + of_q * part.q[i];
      low = minimum(low, at);
      high = maximum(high, at);
    }
    return (low <= slack) & (high >= -slack);
  };
  const MaskOf<T> across = has_both_signs(-y, x);
  // Tests the narrow direction first, because it excludes most parts.
  return any(across) ? across & has_both_signs(x, y) : across;
}

//! Adds halves to the lists that they belong to. Drops halves that cannot hold their star.
template <class T, class Append>
ERGO_HD void sort_halves(const SeenPart<T>& half, unsigned open, int depth, const Append& append) {
  const unsigned held = open & mask_bits(may_hold_star(half.patch, half.error));
  if (held == 0) {
    return;
  }
  const unsigned last = held & mask_bits(half.halvings <= T(static_cast<float>(depth)));
  // Halves are tested for regularity only at even depths, as the test costs more than a halving.
  // Those that are not halved again are always tested.
  const unsigned asked = depth % 2 == 0 ? held : last;
  const unsigned regular = asked == 0 ? 0U : asked & mask_bits(is_regular(half.patch));
  append(regular_parts, half, regular);
  append(folded_parts, half, last & ~regular);
  append(to_halve, half, held & ~last & ~regular);
}

template <int Axis, class T, class Append>
ERGO_HD void halve_along(const SeenPart<T>& whole, unsigned open, int depth, const Append& append) {
  SeenPart<T> half[2];
  split_points(whole.patch.p, Axis, half[0].patch.p, half[1].patch.p);
  split_points(whole.patch.q, Axis, half[0].patch.q, half[1].patch.q);
  const T size_u(part_size(0, depth));
  const T size_v(part_size(1, depth));
  ERGO_UNROLL
  for (int i = 0; i < 2; ++i) {
    half[i].u = Axis == 0 && i == 1 ? whole.u + size_u : whole.u;
    half[i].v = Axis == 1 && i == 1 ? whole.v + size_v : whole.v;
    half[i].size_u = size_u;
    half[i].size_v = size_v;
    half[i].pair = whole.pair;
    half[i].error = whole.error;
    half[i].halvings = whole.halvings;
    sort_halves(half[i], open, depth, append);
  }
}
}  // namespace detail

//! Returns the whole patches of the pairs first, first + 1, ... as parts.
template <class T>
ERGO_HD SeenPart<T> whole_patches(const PatchPairBatch& pairs, int first) {
  const auto gather = [&](const auto& number) {
    return detail::gather_numbers<T>(pairs, first,
                                     [&](const SearchedPair& pair) { return number(pairs.patches[pair.patch]); });
  };
  return {see_patches<T>(pairs, first),
          T(0.0F),
          T(0.0F),
          T(1.0F),
          T(1.0F),
          T(static_cast<float>(first)) + lane_numbers<T>(),
          gather([](const StarPatch& patch) { return patch.error; }),
          gather([](const StarPatch& patch) { return static_cast<float>(patch.halvings); })};
}

//! Halves the parts first, first + 1, ... before `last`, which have been halved `depth` times,
//! along u and v in turn. Calls append(list, half, lanes) with the lanes of a half that belong to a
//! PartList.
template <class T, class Append>
ERGO_HD void halve_parts(const SeenParts& parts, int first, int last, int depth, const Append& append) {
  const SeenPart<T> whole = load_parts<T>(parts, first);
  const unsigned open = bits_within<T>(first, last);
  if (depth % 2 == 0) {
    detail::halve_along<0>(whole, open, depth + 1, append);
  } else {
    detail::halve_along<1>(whole, open, depth + 1, append);
  }
}

//! Writes whole patches as their stars see them. Index i covers pairs i * lanes to
//! (i + 1) * lanes - 1.
template <class T>
struct SeePatches {
  const SeePatchesBatch& batch;

  ERGO_HD void operator()(int index) const {
    const int first = index * RealTraits<T>::lane_count;
    const SeenParts& to = batch.whole;
    store_parts(whole_patches<T>(batch.pairs, first), [&](int channel, const T& value) {
      store_lanes(to.at + channel * to.room, first, batch.pairs.count, value);
    });
  }
};

//! Halves parts. Runs once, for all packs of parts in turn, because each pack appends to the lists.
template <class T>
struct HalveParts {
  static constexpr int lanes = RealTraits<T>::lane_count;
  static_assert(lanes <= part_padding);

  const HalvePartsBatch& batch;

  ERGO_HD void operator()(int /*index*/) const {
    const auto append = [&](PartList list, const SeenPart<T>& half, unsigned which) {
      if (which == 0) {
        return;
      }
      SeenParts& to = *batch.lists[list];
      const ChosenLanes<T> chosen(which);
      store_parts(half,
                  [&](int channel, const T& value) { chosen.store(to.at + channel * to.room + to.count, value); });
      to.count += chosen.count();
    };
    for (int first = batch.first; first < batch.last; first += lanes) {
      halve_parts<T>(batch.parts, first, batch.last, batch.depth, append);
    }
  }
};

template <class T, class Action>
void dispatch(const SeePatchesBatch& batch, const Action& action) {
  action(SeePatches<T>{batch});
}

template <class T, class Action>
void dispatch(const HalvePartsBatch& batch, const Action& action) {
  action(HalveParts<T>{batch});
}

}  // namespace ergodome::inline ERGO_TARGET
