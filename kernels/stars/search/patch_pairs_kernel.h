#pragma once

#include <type_traits>
#include <utility>

#include "kernels/core/lanes.h"
#include "kernels/stars/search/patch_newton.h"
#include "kernels/stars/search/patch_pairs.h"

// Kernels that find where a patch holds a star, for pairs of a patch and a star.
namespace ergodome::inline ERGO_TARGET {

namespace detail {
#if defined(__AVX512F__)
//! Exchanges lanes and elements of 16 packs: lane j of pack i becomes lane i of pack j.
template <class T>
void transpose(T (&packs)[16]) {
  const auto exchange = [&]<int Step, int... Lane>(std::integral_constant<int, Step> /*step*/,
                                                   std::integer_sequence<int, Lane...> /*lanes*/) {
    ERGO_UNROLL
    for (int i = 0; i < 16; ++i) {
      if ((i & Step) == 0) {
        const auto low = packs[i].lanes;
        const auto high = packs[i + Step].lanes;
        packs[i] = T(__builtin_shufflevector(low, high, ((Lane & Step) == 0 ? Lane : 16 + Lane - Step)...));
        packs[i + Step] = T(__builtin_shufflevector(low, high, ((Lane & Step) == 0 ? Lane + Step : 16 + Lane)...));
      }
    }
  };
  constexpr std::make_integer_sequence<int, 16> lanes;
  exchange(std::integral_constant<int, 1>(), lanes);
  exchange(std::integral_constant<int, 2>(), lanes);
  exchange(std::integral_constant<int, 4>(), lanes);
  exchange(std::integral_constant<int, 8>(), lanes);
}
#endif

//! Gathers the results of number(pair) for the pairs first, first + 1, ..., one pair per lane.
template <class T, class Number>
ERGO_HD T gather_numbers(const PatchPairBatch& pairs, int first, const Number& number) {
  T value;
  for (int lane = 0; lane < RealTraits<T>::lane_count; ++lane) {
    set_lane(value, lane, number(pairs.pairs[first + lane < pairs.count ? first + lane : pairs.count - 1]));
  }
  return value;
}

//! Gathers one coordinate of the control points `which` of the patches of pairs first, first + 1,
//! ..., one patch per lane.
template <class T, int Count>
ERGO_HD void gather_points(const PatchPairBatch& pairs, int first, const float (BezierPatch::*points)[16],
                           const int (&which)[Count], T (&to)[Count]) {
  for (int lane = 0; lane < RealTraits<T>::lane_count; ++lane) {
    const int pair = first + lane < pairs.count ? first + lane : pairs.count - 1;
    const float(&from)[16] = pairs.patches[pairs.pairs[pair].patch].sky.*points;
    ERGO_UNROLL
    for (int i = 0; i < Count; ++i) {
      set_lane(to[i], lane, from[which[i]]);
    }
  }
}

//! Gathers one coordinate of all control points of the patches of pairs first, first + 1, ..., one
//! patch per lane.
template <class T>
ERGO_HD void gather_all_points(const PatchPairBatch& pairs, int first, const float (BezierPatch::*points)[16],
                               T (&to)[16]) {
#if defined(__AVX512F__)
  // Filling packs lane by lane takes longer than loading whole packs and exchanging their lanes.
  for (int lane = 0; lane < 16; ++lane) {
    const int pair = first + lane < pairs.count ? first + lane : pairs.count - 1;
    to[lane] = load_lanes<T>(pairs.patches[pairs.pairs[pair].patch].sky.*points, 0, 16);
  }
  transpose(to);
#else
  constexpr int all[16] = {0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15};
  gather_points(pairs, first, points, all, to);
#endif
}

//! Computes the control points `which` of the patches of pairs first, first + 1, ... as their stars
//! see them.
template <class T, int Count>
ERGO_HD void see_points(const PatchPairBatch& pairs, int first, const int (&which)[Count], T* p, T* q) {
  T x[Count];
  T y[Count];
  T z[Count];
  gather_points(pairs, first, &BezierPatch::x, which, x);
  gather_points(pairs, first, &BezierPatch::y, which, y);
  gather_points(pairs, first, &BezierPatch::z, which, z);
  const T a = gather_numbers<T>(pairs, first, [](const SearchedPair& pair) { return pair.a; });
  const T b = gather_numbers<T>(pairs, first, [](const SearchedPair& pair) { return pair.b; });
  ERGO_UNROLL
  for (int i = 0; i < Count; ++i) {
    p[i] = x[i] - a * z[i];
    q[i] = y[i] - b * z[i];
  }
}
}  // namespace detail

//! Returns the patches of the pairs first, first + 1, ... as their stars see them.
template <class T>
ERGO_HD SeenPatch<T> see_patches(const PatchPairBatch& pairs, int first) {
  T x[16];
  T y[16];
  T z[16];
  detail::gather_all_points(pairs, first, &BezierPatch::x, x);
  detail::gather_all_points(pairs, first, &BezierPatch::y, y);
  detail::gather_all_points(pairs, first, &BezierPatch::z, z);
  const T a = detail::gather_numbers<T>(pairs, first, [](const SearchedPair& pair) { return pair.a; });
  const T b = detail::gather_numbers<T>(pairs, first, [](const SearchedPair& pair) { return pair.b; });
  SeenPatch<T> patch;
  ERGO_UNROLL
  for (int i = 0; i < 16; ++i) {
    patch.p[i] = x[i] - a * z[i];
    patch.q[i] = y[i] - b * z[i];
  }
  return patch;
}

//! Seeks the stars of the pairs first, first + 1, ... by Newton's method from the middle of their
//! patches.
template <class T>
ERGO_HD PatchRoot<T> invert_patches(const PatchPairBatch& pairs, int first, const NewtonLimits& limits) {
  return newton_on_patch(see_patches<T>(pairs, first), T(0.0F) < T(1.0F), {T(0.5F), T(0.5F)}, limits.farthest,
                         limits.rounds);
}

//! Seeks stars in patches. Index i covers pairs i * lanes to (i + 1) * lanes - 1.
template <class T>
struct InvertPatches {
  const PatchNewtonBatch& batch;

  ERGO_HD void operator()(int index) const {
    const int count = batch.pairs.count;
    const int first = index * RealTraits<T>::lane_count;
    const PatchRoot<T> root = invert_patches<T>(batch.pairs, first, batch.limits);
    store_lanes(batch.found, first, count, select(root.found, T(1.0F), T(0.0F)));
    store_lanes(batch.u, first, count, root.at.u);
    store_lanes(batch.v, first, count, root.at.v);
    store_lanes(batch.area, first, count, root.area);
  }
};

//! Finds on which side of patches' borders stars are, by the winding number of the border about the
//! star. Index i covers pairs i * lanes to (i + 1) * lanes - 1.
//!
//! Each side is a cubic curve, approximated by chords. A star counts as `beside` if it is so near
//! to a chord that the error of the chord, the margin within which images are accepted outside a
//! patch, or rounding might change the result.
template <class T>
struct FindPatchSides {
  using Mask = MaskOf<T>;

  const PatchSideBatch& batch;

  ERGO_HD void operator()(int index) const {
    const int first = index * RealTraits<T>::lane_count;
    store_lanes(batch.side, first, batch.pairs.count, sides(batch.pairs, first));
  }

  //! Returns the PatchSide of the pairs first, first + 1, ...
  ERGO_HD static T sides(const PatchPairBatch& pairs, int first) {
    // Indices of the control points round the border of the patch: along its first row, up the last
    // column, back along the last row, down the first column.
    constexpr int border[12] = {0, 1, 2, 3, 7, 11, 15, 14, 13, 12, 8, 4};
    T p[13];
    T q[13];
    detail::see_points(pairs, first, border, p, q);
    p[12] = p[0];
    q[12] = q[0];
    Round round{T(0.0F), T(1.0F) < T(0.0F)};
    T length[4];
    for (int side = 0; side < 4; ++side) {
      length[side] = absolute(p[3 * side + 3] - p[3 * side]) + absolute(q[3 * side + 3] - q[3 * side]);
    }
    for (int side = 0; side < 4; ++side) {
      // Images are accepted outside a side by a fraction of the patch's extent across that side.
      const T across = maximum(length[(side + 1) % 4], length[(side + 3) % 4]);
      go_along(p + 3 * side, q + 3 * side, across * (2.0F * beyond_patch) + T(rounding), round);
    }
    const T inside = select(absolute(round.turns) > T(0.5F), T(1.0F), T(0.0F));
    return select(round.beside, T(2.0F), inside);
  }

 private:
  static constexpr int chords = 8;
  //! Rounding error of positions on the sky in float.
  static constexpr float rounding = 2e-7F;

  //! State of a walk round the border.
  struct Round {
    T turns;  //!< winding number about the star
    Mask beside;
  };

  ERGO_HD static void go_along(const T* p, const T* q, const T& margin, Round& round) {
    const T slack = chord_error(p, q) + margin;
    T from_p = p[0];
    T from_q = q[0];
    for (int chord = 1; chord <= chords; ++chord) {
      float along[4];
      float slope[4];
      detail::bernstein(static_cast<float>(chord) / chords, along, slope);
      const T to_p = along[0] * p[0] + along[1] * p[1] + along[2] * p[2] + along[3] * p[3];
      const T to_q = along[0] * q[0] + along[1] * q[1] + along[2] * q[2] + along[3] * q[3];
      pass(from_p, from_q, to_p, to_q, slack, round);
      from_p = to_p;
      from_q = to_q;
    }
  }

  //! Returns an upper limit of the distance between a side and its chords.
  ERGO_HD static T chord_error(const T* p, const T* q) {
    const auto bend = [](const T* at) {
      return maximum(absolute(at[0] - T(2.0F) * at[1] + at[2]), absolute(at[1] - T(2.0F) * at[2] + at[3]));
    };
    // A cubic's second derivative by its parameter is at most 6 times these differences. A chord
    // differs from it by at most an eighth of that times the square of the parameter's step.
    constexpr float chord_part = 6.0F / (8.0F * chords * chords);
    return (bend(p) + bend(q)) * chord_part;
  }

  //! Updates winding number and nearness for one chord.
  ERGO_HD static void pass(const T& from_p, const T& from_q, const T& to_p, const T& to_q, const T& slack,
                           Round& round) {
    const T zero(0.0F);
    const T way_p = to_p - from_p;
    const T way_q = to_q - from_q;
    // `left` is positive where the star, which is the origin, is to the left of the chord.
    const T left = from_p * to_q - from_q * to_p;
    const Mask up = (from_q <= zero) & (to_q > zero) & (left > zero);
    const Mask down = (from_q > zero) & (to_q <= zero) & (left < zero);
    round.turns = round.turns + select(up, T(1.0F), zero) - select(down, T(1.0F), zero);
    const T length = sqrt(way_p * way_p + way_q * way_q);
    const T reach = slack * length;
    const T before = -(from_p * way_p + from_q * way_q);
    const T after = to_p * way_p + to_q * way_q;
    round.beside = round.beside | ((absolute(left) <= reach) & (before >= -reach) & (after >= -reach));
  }
};

template <class T, class Action>
void dispatch(const PatchSideBatch& batch, const Action& action) {
  action(FindPatchSides<T>{batch});
}

template <class T, class Action>
void dispatch(const PatchNewtonBatch& batch, const Action& action) {
  action(InvertPatches<T>{batch});
}

}  // namespace ergodome::inline ERGO_TARGET
