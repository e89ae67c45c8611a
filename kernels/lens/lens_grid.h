#pragma once

#include "kernels/core/lanes.h"
#include "kernels/core/quad.h"
#include "kernels/lens/lens_chart.h"

// Lens grids, and how they are read.
namespace ergodome {

//! Floats per node: the sky direction, its derivatives along γ [turns] and s, and the mixed
//! derivative. Each has x, y, z and a padding float, so that a node fills a cache line.
inline constexpr int floats_a_node = 16;

//! Maximum depth from a root cell to a leaf.
inline constexpr int deepest_cell = 24;

//! A lens grid as kernels read it: a binary hierarchy of cells over the chart, with a bicubic
//! Hermite patch per leaf.
//!
//! `tree` starts with columns x rows root cells (γ fastest). An entry e >= 0 is split along axis e
//! & 1 (0: γ, 1: s) into the cells tree[e >> 1] and tree[(e >> 1) + 1]. An entry e < 0 is a leaf
//! with number (-1 - e) >> 1. If (-1 - e) & 1 is set, the leaf did not become accurate and its
//! pixels must be traced.
struct LensGrid {
  LensChart chart;
  //! 1 if the sky at -γ is the sky at γ, mirrored in the equator; the grid then contains only the
  //! first half turn.
  int mirrored;
  int columns;
  int rows;
  const int* tree;
  const int* leaves;  //!< four nodes per leaf: (γ0, s0), (γ1, s0), (γ0, s1), (γ1, s1)
  const float* nodes;
};

//! A leaf and its rectangle in the chart.
struct Leaf {
  int number;
  bool flagged;       //!< the leaf is not accurate: trace the ray instead
  float gamma_turns;  //!< lower end of the leaf along γ
  float s;            //!< lower end of the leaf along s
  float width_turns;
  float height;  //!< extent of the leaf along s
};

inline namespace ERGO_TARGET {

//! Finds the leaf at (γ, s), both clamped to the grid. A mirrored grid covers only γ up to half a
//! turn, so callers mirror larger γ first.
ERGO_HD Leaf find_leaf(const LensGrid& grid, float gamma_turns, float s) {
  Leaf at{};
  at.width_turns = (grid.mirrored != 0 ? 0.5F : 1.0F) / static_cast<float>(grid.columns);
  at.height = 1.0F / static_cast<float>(grid.rows);
  const auto root = [](float value, float extent, int count) {
    const int whole = static_cast<int>(minimum(maximum(value / extent, 0.0F), static_cast<float>(count)));
    return whole < count ? whole : count - 1;
  };
  const int column = root(gamma_turns, at.width_turns, grid.columns);
  const int row = root(s, at.height, grid.rows);
  at.gamma_turns = static_cast<float>(column) * at.width_turns;
  at.s = static_cast<float>(row) * at.height;
  int entry = grid.tree[row * grid.columns + column];
  for (int depth = 0; depth < deepest_cell && entry >= 0; ++depth) {
    const bool along_gamma = (entry & 1) == 0;
    float& extent = along_gamma ? at.width_turns : at.height;
    float& begin = along_gamma ? at.gamma_turns : at.s;
    extent *= 0.5F;
    const int second = (along_gamma ? gamma_turns : s) >= begin + extent ? 1 : 0;
    begin += static_cast<float>(second) * extent;
    entry = grid.tree[(entry >> 1) + second];
  }
  const int code = -1 - entry;
  at.number = code >> 1;
  at.flagged = (code & 1) != 0;
  return at;
}

//! A position in a leaf: in [0, 1] along γ and s.
struct LeafPosition {
  float u;
  float v;
};

ERGO_HD LeafPosition position_in(const Leaf& leaf, float gamma_turns, float s) {
  const auto part = [](float value, float begin, float extent) {
    return minimum(maximum((value - begin) / extent, 0.0F), 1.0F);
  };
  return {part(gamma_turns, leaf.gamma_turns, leaf.width_turns), part(s, leaf.s, leaf.height)};
}

//! Returns whether a position is strictly inside a leaf, so that it cannot belong to another leaf.
ERGO_HD bool holds(const Leaf& leaf, float gamma_turns, float s) {
  const float across = gamma_turns - leaf.gamma_turns;
  const float up = s - leaf.s;
  return across > 0.0F && across < leaf.width_turns && up > 0.0F && up < leaf.height;
}

//! Computes the cubic Hermite basis at t (value at 0, slope at 0, value at 1, slope at 1) and its
//! derivative by t.
ERGO_HD void hermite_basis(float t, float (&basis)[4], float (&slope)[4]) {
  const float t2 = t * t;
  const float t3 = t2 * t;
  basis[0] = 2.0F * t3 - 3.0F * t2 + 1.0F;
  basis[1] = t3 - 2.0F * t2 + t;
  basis[2] = 3.0F * t2 - 2.0F * t3;
  basis[3] = t3 - t2;
  slope[0] = 6.0F * (t2 - t);
  slope[1] = 3.0F * t2 - 4.0F * t + 1.0F;
  slope[2] = 6.0F * (t - t2);
  slope[3] = 3.0F * t2 - 2.0F * t;
}

//! The sum of a bicubic patch: the sky direction before normalization, and its derivatives along γ
//! [turns] and s.
struct PatchValue {
  //! Components x, y, z, and as the fourth the summed weights of the corners whose rays come from
  //! the sky: 1 if all do.
  Quad sky;
  Quad along_gamma;
  Quad along_s;
};

//! Sums the patch of four nodes at (u, v) in a cell of the given extent.
ERGO_HD PatchValue patch_value(const float* nodes, const int* corners, float u, float v, float width_turns,
                               float height) {
  float along_u[4];
  float slope_u[4];
  float along_v[4];
  float slope_v[4];
  hermite_basis(u, along_u, slope_u);
  hermite_basis(v, along_v, slope_v);
  const float per_turn = 1.0F / width_turns;
  const float per_s = 1.0F / height;
  PatchValue sum = {quad_of(0.0F), quad_of(0.0F), quad_of(0.0F)};
  ERGO_UNROLL
  for (int corner = 0; corner < 4; ++corner) {
    const float* node = nodes + floats_a_node * corners[corner];
    const int i = 2 * (corner & 1);
    const int j = 2 * (corner >> 1);
    // Sums along γ first: the value and the derivative along s, each with its rate along γ.
    const Quad value = load_quad(node);
    const Quad by_gamma = load_quad(node + 4);
    const Quad by_s = load_quad(node + 8);
    const Quad mixed = load_quad(node + 12);
    const float b = width_turns * along_u[i + 1];
    const Quad at_value = along_u[i] * value + b * by_gamma;
    const Quad at_slope = along_u[i] * by_s + b * mixed;
    const float a_rate = per_turn * slope_u[i];
    const Quad rate_value = a_rate * value + slope_u[i + 1] * by_gamma;
    const Quad rate_slope = a_rate * by_s + slope_u[i + 1] * mixed;
    const float d = height * along_v[j + 1];
    sum.sky = sum.sky + along_v[j] * at_value + d * at_slope;
    sum.along_gamma = sum.along_gamma + along_v[j] * rate_value + d * rate_slope;
    sum.along_s = sum.along_s + (per_s * slope_v[j]) * at_value + slope_v[j + 1] * at_slope;
  }
  return sum;
}

//! A sky direction read from a grid.
template <class T>
struct GridSky {
  Vector3<Dual<T>> sky;  //!< unit vector, with derivatives along the directions of the position
  MaskOf<T> flagged;     //!< the leaf is not accurate
};

namespace detail {

//! Patch sums of all lanes, component by component: x, y, z of the sky direction, of its derivative
//! along γ, and of that along s; then 1 if the leaf is flagged, otherwise 0.
template <class T>
struct PatchLanes {
  ScalarOf<T> of[10][RealTraits<T>::lane_count];

  ERGO_HD void set(int lane, const PatchValue& value, bool flagged) {
    ERGO_UNROLL
    for (int i = 0; i < 3; ++i) {
      of[i][lane] = ScalarOf<T>(quad_part(value.sky, i));
      of[3 + i][lane] = ScalarOf<T>(quad_part(value.along_gamma, i));
      of[6 + i][lane] = ScalarOf<T>(quad_part(value.along_s, i));
    }
    of[9][lane] = ScalarOf<T>(flagged ? 1 : 0);
  }

  //! Sets a lane's sky direction to +z, without derivatives, so that results computed from it are
  //! finite.
  ERGO_HD void clear(int lane) {
    ERGO_UNROLL
    for (int i = 0; i < 10; ++i) {
      of[i][lane] = ScalarOf<T>(i == 2 ? 1 : 0);
    }
  }

  ERGO_HD T component(int i) const { return load_lanes<T>(of[i], 0, RealTraits<T>::lane_count); }
};

//! Reads the patches of the wanted lanes. Neighbors mostly share a leaf, so the last one found is
//! tried first.
template <class T>
ERGO_HD void read_patches(const LensGrid& grid, const T& gamma_turns, const T& s, const MaskOf<T>& wanted,
                          PatchLanes<T>& into) {
  constexpr int lanes = RealTraits<T>::lane_count;
  ScalarOf<T> across[lanes];
  ScalarOf<T> up[lanes];
  store_lanes(across, 0, lanes, gamma_turns);
  store_lanes(up, 0, lanes, s);
  Leaf leaf{};
  for (int i = 0; i < lanes; ++i) {
    if (!mask_lane(wanted, i)) {
      into.clear(i);
      continue;
    }
    const auto x = static_cast<float>(across[i]);
    const auto y = static_cast<float>(up[i]);
    if (!holds(leaf, x, y)) {
      leaf = find_leaf(grid, x, y);
    }
    const LeafPosition at = position_in(leaf, x, y);
    into.set(i, patch_value(grid.nodes, grid.leaves + 4 * leaf.number, at.u, at.v, leaf.width_turns, leaf.height),
             leaf.flagged);
  }
}

}  // namespace detail

//! Reads the grid at a position of its chart (camera at φ = 0), for the wanted lanes; the others
//! are undefined.
template <class T>
ERGO_HD GridSky<T> read_grid(const LensGrid& grid, const ChartPosition<Dual<T>>& position, const MaskOf<T>& wanted) {
  using S = ScalarOf<T>;
  using D = Dual<T>;
  // A mirrored grid is read at -γ, backwards in γ, and its sky is mirrored.
  const T one(S(1));
  const T whole = position.gamma_turns.value;
  const auto over = (whole > T(S(0.5))) & (T(S(grid.mirrored)) > T(S(0)));
  const T mirror = select(over, -one, one);
  detail::PatchLanes<T> patches;
  detail::read_patches(grid, select(over, one - whole, whole), position.s.value, wanted, patches);
  const auto chained = [&](int i, const T& side) {
    const T turned = patches.component(3 + i) * mirror * side;
    const T upward = patches.component(6 + i) * side;
    return D(patches.component(i) * side, turned * position.gamma_turns.along_x + upward * position.s.along_x,
             turned * position.gamma_turns.along_y + upward * position.s.along_y);
  };
  const Vector3<D> v = {chained(0, one), chained(1, one), chained(2, mirror)};
  // The small term prevents 0 / 0 where no corner has a sky.
  const D inverse = D(T(S(1))) / sqrt(dot(v, v) + D(T(S(1e-30))));
  return {{v.x * inverse, v.y * inverse, v.z * inverse}, patches.component(9) > T(S(0.5))};
}

//! Reads the grid for all lanes.
template <class T>
ERGO_HD GridSky<T> read_grid(const LensGrid& grid, const ChartPosition<Dual<T>>& position) {
  return read_grid(grid, position, T(ScalarOf<T>(0)) < T(ScalarOf<T>(1)));
}

}  // namespace ERGO_TARGET
}  // namespace ergodome
