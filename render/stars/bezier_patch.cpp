#include "render/stars/bezier_patch.h"

#include <algorithm>
#include <cmath>

namespace ergodome {

namespace {

//! Halves each of the four rows (axis 0) or columns (axis 1) of control points by de Casteljau's construction.
void split_points(const float (&from)[16], int axis, float (&first)[16], float (&second)[16]) {
  const int along = axis == 0 ? 1 : 4;
  const int across = axis == 0 ? 4 : 1;
  for (int line = 0; line < 4; ++line) {
    const int at = line * across;
    const float a = from[at];
    const float b = from[at + along];
    const float c = from[at + 2 * along];
    const float d = from[at + 3 * along];
    const float ab = 0.5F * (a + b);
    const float bc = 0.5F * (b + c);
    const float cd = 0.5F * (c + d);
    const float abc = 0.5F * (ab + bc);
    const float bcd = 0.5F * (bc + cd);
    const float middle = 0.5F * (abc + bcd);
    first[at] = a;
    first[at + along] = ab;
    first[at + 2 * along] = abc;
    first[at + 3 * along] = middle;
    second[at] = middle;
    second[at + along] = bcd;
    second[at + 2 * along] = cd;
    second[at + 3 * along] = d;
  }
}

//! Bernstein's cubics at t, and their derivatives.
void bernstein(float t, float (&basis)[4], float (&slope)[4]) {
  const float r = 1.0F - t;
  basis[0] = r * r * r;
  basis[1] = 3.0F * r * r * t;
  basis[2] = 3.0F * r * t * t;
  basis[3] = t * t * t;
  slope[0] = -3.0F * r * r;
  slope[1] = 3.0F * r * (r - 2.0F * t);
  slope[2] = 3.0F * t * (2.0F * r - t);
  slope[3] = 3.0F * t * t;
}

bool same_side(const float (&values)[16]) {
  float lowest = values[0];
  float highest = values[0];
  for (int i = 1; i < 16; ++i) {
    lowest = std::min(lowest, values[i]);
    highest = std::max(highest, values[i]);
  }
  // Roots on a border belong to both sides, whatever rounding says.
  const float slack = 1e-3F * (highest - lowest);
  return lowest > slack || highest < -slack;
}

}  // namespace

BezierPatch bezier_patch(const LensGrid& grid, int leaf, float width_turns, float height) {
  BezierPatch patch{};
  float* const parts[3] = {patch.x, patch.y, patch.z};
  for (int corner = 0; corner < 4; ++corner) {
    const float* node = grid.nodes + floats_a_node * grid.leaves[4 * leaf + corner];
    const int column = corner & 1;
    const int row = corner >> 1;
    // From the corner inwards; control points lie a third of the derivative away.
    const float along_u = (column == 0 ? width_turns : -width_turns) / 3.0F;
    const float along_v = (row == 0 ? height : -height) / 3.0F;
    for (int i = 0; i < 3; ++i) {
      const float value = node[i];
      const float by_u = along_u * node[4 + i];
      const float by_v = along_v * node[8 + i];
      const float mixed = along_u * along_v * node[12 + i];
      float* to = parts[i];
      to[4 * (3 * row) + 3 * column] = value;
      to[4 * (3 * row) + 1 + column] = value + by_u;
      to[4 * (1 + row) + 3 * column] = value + by_v;
      to[4 * (1 + row) + 1 + column] = value + by_u + by_v + mixed;
    }
  }
  return patch;
}

void split(const BezierPatch& patch, int axis, BezierPatch& first, BezierPatch& second) {
  split_points(patch.x, axis, first.x, second.x);
  split_points(patch.y, axis, first.y, second.y);
  split_points(patch.z, axis, first.z, second.z);
}

void split(const PlanePatch& patch, int axis, PlanePatch& first, PlanePatch& second) {
  split_points(patch.p, axis, first.p, second.p);
  split_points(patch.q, axis, first.q, second.q);
}

bool may_hold_origin(const PlanePatch& patch) { return !same_side(patch.p) && !same_side(patch.q); }

PlaneValue evaluate(const PlanePatch& patch, float u, float v) {
  float along_u[4];
  float slope_u[4];
  float along_v[4];
  float slope_v[4];
  bernstein(u, along_u, slope_u);
  bernstein(v, along_v, slope_v);
  PlaneValue sum{};
  for (int row = 0; row < 4; ++row) {
    float p = 0.0F;
    float q = 0.0F;
    float p_u = 0.0F;
    float q_u = 0.0F;
    for (int column = 0; column < 4; ++column) {
      const int i = 4 * row + column;
      p += along_u[column] * patch.p[i];
      q += along_u[column] * patch.q[i];
      p_u += slope_u[column] * patch.p[i];
      q_u += slope_u[column] * patch.q[i];
    }
    sum.p += along_v[row] * p;
    sum.q += along_v[row] * q;
    sum.p_u += along_v[row] * p_u;
    sum.q_u += along_v[row] * q_u;
    sum.p_v += slope_v[row] * p;
    sum.q_v += slope_v[row] * q;
  }
  return sum;
}

bool find_origin(const PlanePatch& patch, float& u, float& v) {
  for (int round = 0; round < 16; ++round) {
    const PlaneValue f = evaluate(patch, u, v);
    const float determinant = f.p_u * f.q_v - f.p_v * f.q_u;
    const float du = (f.p * f.q_v - f.p_v * f.q) / determinant;
    const float dv = (f.p_u * f.q - f.p * f.q_u) / determinant;
    const float length = std::max(std::abs(du), std::abs(dv));
    if (!(length < 1e6F)) {
      return false;
    }
    const float part = std::min(1.0F, 0.5F / length);
    u -= part * du;
    v -= part * dv;
    if (u < -1.0F || u > 2.0F || v < -1.0F || v > 2.0F) {
      return false;
    }
    if (length < 1e-4F) {
      return true;
    }
  }
  return false;
}

}  // namespace ergodome
