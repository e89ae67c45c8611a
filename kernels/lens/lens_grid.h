#pragma once

#include "kernels/core/quad.h"
#include "kernels/lens/lens_chart.h"

namespace ergodome {

//! Floats a node takes: the sky direction, its derivatives along γ [turns] and s, and the mixed one; each x, y, z and a pad, so that
//! a node is a cache line.
inline constexpr int floats_a_node = 16;

//! Deepest descent from a root cell to a leaf.
inline constexpr int deepest_cell = 24;

//! A lens grid as kernels read it: a binary hierarchy of cells over the conforming chart, with a bicubic Hermite patch a leaf.
//!
//! `tree` starts with columns x rows root cells (γ fastest). An entry e >= 0 is split along axis e & 1 (0: γ, 1: s) into the cells
//! tree[e >> 1] and tree[(e >> 1) + 1]; an entry e < 0 is a leaf: number (-1 - e) >> 1, and (-1 - e) & 1 says that the leaf could
//! not be made good and its pixels are to be traced.
struct LensGrid {
  LensChart chart;
  int mirrored;  //!< 1: the sky at -γ is the sky at γ, mirrored in the equator; the grid holds the first half turn alone
  int columns;
  int rows;
  const int* tree;
  const int* leaves;  //!< four nodes a leaf: (γ0, s0), (γ1, s0), (γ0, s1), (γ1, s1)
  const float* nodes;
};

//! A leaf and the place in it.
struct LeafPlace {
  int leaf;
  bool flagged;       //!< trace the ray instead
  float u;            //!< in [0, 1], along γ
  float v;            //!< in [0, 1], along s
  float width_turns;  //!< the leaf's extent along γ
  float height;       //!< the leaf's extent along s
};

inline namespace ERGO_TARGET {

//! Finds the leaf at (γ, s); both are clamped to the grid. γ of a mirrored grid is at most half a turn.
ERGO_HD LeafPlace find_leaf(const LensGrid& grid, float gamma_turns, float s) {
  const float root_width = (grid.mirrored != 0 ? 0.5F : 1.0F) / static_cast<float>(grid.columns);
  const float root_height = 1.0F / static_cast<float>(grid.rows);
  const auto place = [](float value, int count, int& cell) {
    const float clamped = minimum(maximum(value, 0.0F), static_cast<float>(count));
    const int whole = static_cast<int>(clamped);
    cell = whole < count ? whole : count - 1;
    return clamped - static_cast<float>(cell);
  };
  int column = 0;
  int row = 0;
  LeafPlace at{};
  at.u = place(gamma_turns / root_width, grid.columns, column);
  at.v = place(s / root_height, grid.rows, row);
  at.width_turns = root_width;
  at.height = root_height;
  int entry = grid.tree[row * grid.columns + column];
  for (int depth = 0; depth < deepest_cell && entry >= 0; ++depth) {
    float& along = (entry & 1) == 0 ? at.u : at.v;
    ((entry & 1) == 0 ? at.width_turns : at.height) *= 0.5F;
    along *= 2.0F;
    const int second = along >= 1.0F ? 1 : 0;
    along -= static_cast<float>(second);
    entry = grid.tree[(entry >> 1) + second];
  }
  const int code = -1 - entry;
  at.leaf = code >> 1;
  at.flagged = (code & 1) != 0;
  return at;
}

//! Cubic Hermite basis at t: value at 0, slope at 0, value at 1, slope at 1; and its derivative.
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

//! A bicubic patch's sum: the sky direction before it is normalized, and its derivatives along γ [turns] and s.
struct PatchValue {
  Quad sky;  //!< x, y, z, and the sum of the corners' weights of those that have a sky: 1 when all have
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
    // Along γ first: the value and the derivative along s, each with its rate along γ.
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
  Vector3<Dual<T>> sky;  //!< unit vector, with derivatives along the same directions as the place asked for
  MaskOf<T> flagged;     //!< the leaf could not be made good
};

//! Reads the grid at a place of its chart (camera at φ = 0).
template <class T>
ERGO_HD GridSky<T> read_grid(const LensGrid& grid, const ChartPlace<Dual<T>>& place) {
  using S = ScalarOf<T>;
  using D = Dual<T>;
  Vector3<T> sum;
  Vector3<T> along_gamma;
  Vector3<T> along_s;
  T flag(S(0));
  // A mirrored grid is read at -γ, backwards in γ, and its sky turned over.
  const T one(S(1));
  const T whole = place.gamma_turns.value;
  const auto over = (whole > T(S(0.5))) & (T(S(grid.mirrored)) > T(S(0)));
  const T mirror = select(over, -one, one);
  const T gamma_turns = select(over, one - whole, whole);
  for (int i = 0; i < RealTraits<T>::lane_count; ++i) {
    const LeafPlace at =
        find_leaf(grid, static_cast<float>(lane(gamma_turns, i)), static_cast<float>(lane(place.s.value, i)));
    const PatchValue value = patch_value(grid.nodes, grid.leaves + 4 * at.leaf, at.u, at.v, at.width_turns, at.height);
    set_lane(sum.x, i, S(quad_part(value.sky, 0)));
    set_lane(sum.y, i, S(quad_part(value.sky, 1)));
    set_lane(sum.z, i, S(quad_part(value.sky, 2)));
    set_lane(along_gamma.x, i, S(quad_part(value.along_gamma, 0)));
    set_lane(along_gamma.y, i, S(quad_part(value.along_gamma, 1)));
    set_lane(along_gamma.z, i, S(quad_part(value.along_gamma, 2)));
    set_lane(along_s.x, i, S(quad_part(value.along_s, 0)));
    set_lane(along_s.y, i, S(quad_part(value.along_s, 1)));
    set_lane(along_s.z, i, S(quad_part(value.along_s, 2)));
    set_lane(flag, i, S(at.flagged ? 1 : 0));
  }
  const auto chained = [&](const T& value, const T& by_gamma, const T& by_s) {
    const T turned = by_gamma * mirror;
    return D(value, turned * place.gamma_turns.along_x + by_s * place.s.along_x,
             turned * place.gamma_turns.along_y + by_s * place.s.along_y);
  };
  const Vector3<D> v = {chained(sum.x, along_gamma.x, along_s.x), chained(sum.y, along_gamma.y, along_s.y),
                        chained(sum.z * mirror, along_gamma.z * mirror, along_s.z * mirror)};
  const D inverse = D(T(S(1))) / sqrt(dot(v, v));
  return {{v.x * inverse, v.y * inverse, v.z * inverse}, flag > T(S(0.5))};
}

}  // namespace ERGO_TARGET
}  // namespace ergodome
