#pragma once

#include "kernels/core/lanes.h"
#include "kernels/stars/search/patch_pairs_kernel.h"

// Halves parts of patches until Newton's method is safe in each; see seen_parts.h.
namespace ergodome::inline ERGO_TARGET {

//! Writes whole patches as their stars see them; index i stands for the pairs i * lanes, i * lanes
//! + 1, ...
template <class T>
struct SeePatches {
  const SeePatchesBatch& batch;

  ERGO_HD void operator()(int index) const {
    const int first = index * RealTraits<T>::lane_count;
    const PatchPairBatch& pairs = batch.pairs;
    const SeenPatch<T> patch = detail::see_patches<T>(pairs, first);
    const auto store = [&](int channel, const T& value) {
      store_lanes(batch.whole.at + channel * batch.whole.room, first, pairs.count, value);
    };
    for (int i = 0; i < 16; ++i) {
      store(part_p + i, patch.p[i]);
      store(part_q + i, patch.q[i]);
    }
    store(part_u, T(0.0F));
    store(part_v, T(0.0F));
    store(part_pair, T(static_cast<float>(first)) + lane_numbers<T>());
    store(part_error, load_lanes<T>(batch.error, first, pairs.count));
    store(part_halvings, load_lanes<T>(batch.halvings, first, pairs.count));
  }
};

//! Halves parts. Runs once, for all packs of parts in turn, because each pack appends to the lists.
template <class T>
struct HalveParts {
  using Mask = MaskOf<T>;
  static constexpr int lanes = RealTraits<T>::lane_count;
  static_assert(lanes <= part_padding);

  const HalvePartsBatch& batch;

  ERGO_HD void operator()(int /*index*/) const {
    for (int first = batch.first; first < batch.last; first += lanes) {
      if (axis() == 0) {
        halve<0>(first);
      } else {
        halve<1>(first);
      }
    }
  }

 private:
  //! Values that both halves inherit from their part.
  struct Whose {
    T pair, error, halvings;
    unsigned open;  //!< bit mask of the lanes that hold parts
  };

  //! Returns the axis of this halving; u and v alternate.
  [[nodiscard]] ERGO_HD int axis() const { return batch.depth % 2; }

  [[nodiscard]] ERGO_HD T load(int channel, int first) const {
    return load_lanes<T>(batch.parts.at + channel * batch.parts.room, first, batch.parts.count);
  }

  template <int Axis>
  ERGO_HD void halve(int first) const {
    const SeenPatch<T> whole = load_patch<T>(batch.parts, first);
    SeenPatch<T> half[2];
    detail::split_points(whole.p, Axis, half[0].p, half[1].p);
    detail::split_points(whole.q, Axis, half[0].q, half[1].q);
    const Whose whose = {load(part_pair, first), load(part_error, first), load(part_halvings, first),
                         bits_within<T>(first, batch.last)};
    const T u = load(part_u, first);
    const T v = load(part_v, first);
    const float size = part_size(Axis, batch.depth + 1);
    sort(half[0], u, v, whose);
    sort(half[1], Axis == 0 ? u + T(size) : u, Axis == 1 ? v + T(size) : v, whose);
  }

  //! Returns the size of a part along u (axis 0) or v (axis 1) after `depth` halvings, as a
  //! fraction of the patch.
  ERGO_HD static float part_size(int axis, int depth) {
    return 1.0F / static_cast<float>(1U << static_cast<unsigned>((depth + 1 - axis) / 2));
  }

  //! Appends halves to the lists that they belong to. Drops halves that cannot hold their star.
  ERGO_HD void sort(const SeenPatch<T>& half, const T& u, const T& v, const Whose& whose) const {
    const unsigned held = whose.open & mask_bits(may_hold_star(half, whose.error));
    if (held == 0) {
      return;
    }
    const int depth = batch.depth + 1;
    const unsigned last = held & mask_bits(whose.halvings <= T(static_cast<float>(depth)));
    // Tested every other time, as the test costs more than a halving.
    const unsigned asked = depth % 2 == 0 ? held : last;
    const unsigned regular = asked == 0 ? 0U : asked & mask_bits(is_regular(half));
    append(*batch.regular, half, u, v, whose, regular);
    append(*batch.folded, half, u, v, whose, last & ~regular);
    append(*batch.halves, half, u, v, whose, held & ~last & ~regular);
  }

  ERGO_HD void append(SeenParts& to, const SeenPatch<T>& half, const T& u, const T& v, const Whose& whose,
                      unsigned which) const {
    if (which == 0) {
      return;
    }
    const ChosenLanes<T> chosen(which);
    const auto store = [&](int channel, const T& value) { chosen.store(to.at + channel * to.room + to.count, value); };
    ERGO_UNROLL
    for (int i = 0; i < 16; ++i) {
      store(part_p + i, half.p[i]);
      store(part_q + i, half.q[i]);
    }
    store(part_u, u);
    store(part_v, v);
    store(part_size_u, T(part_size(0, batch.depth + 1)));
    store(part_size_v, T(part_size(1, batch.depth + 1)));
    store(part_pair, whose.pair);
    store(part_error, whose.error);
    store(part_halvings, whose.halvings);
    to.count += chosen.count();
  }

  //! Returns the lanes whose star lies within a bounding box of the control points. The box is
  //! aligned with the part, since parts of a bent patch are slivers in any direction.
  ERGO_HD static Mask may_hold_star(const SeenPatch<T>& part, const T& error) {
    T x;
    T y;
    const T length = long_way(part, x, y);
    // Roots on a border belong to both sides, in spite of rounding.
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
    const Mask across = has_both_signs(-y, x);
    // The narrow direction excludes most parts.
    return any(across) ? across & has_both_signs(x, y) : across;
  }

  //! Computes the direction (x, y) in the plane along which each part is longest, approximately, as
  //! unit vectors. Returns the lengths.
  ERGO_HD static T long_way(const SeenPatch<T>& part, T& x, T& y) {
    const auto from_to = [](const T(&at)[16], int a, int b, int c, int d) {
      return T(0.5F) * (at[b] + at[d] - at[a] - at[c]);
    };
    const T along_x = from_to(part.p, 0, 3, 12, 15);
    const T along_y = from_to(part.q, 0, 3, 12, 15);
    const T across_x = from_to(part.p, 0, 12, 3, 15);
    const T across_y = from_to(part.q, 0, 12, 3, 15);
    const T along = along_x * along_x + along_y * along_y;
    const T across = across_x * across_x + across_y * across_y;
    const Mask first = along > across;
    const T length = sqrt(maximum(along, across));
    const Mask some = length > T(1e-15F);
    const T inverse = select(some, T(1.0F) / length, T(0.0F));
    x = select(some, select(first, along_x, across_x) * inverse, T(1.0F));
    y = select(first, along_y, across_y) * inverse;
    return length;
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
