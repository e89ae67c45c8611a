#pragma once

#include "kernels/core/lanes.h"
#include "kernels/core/vector3.h"
#include "kernels/lens/lens_grid.h"

// Bicubic patches of a lens: evaluation, halving, and a test for nearly affine ones.
namespace ergodome {

//! A bicubic patch, given by its control points, row after row along v. For (u, v) in [0, 1]² it
//! lies in their convex hull, and in the convex cone that they span.
struct BezierPatch {
  float x[16];
  float y[16];
  float z[16];
};

//! How a patch of a lens maps the chart to the sky.
enum class PatchShape {
  regular,  //!< nearly affine: Newton's method finds the only image of a star from any start
  //! One to one, but its Jacobian differs from that at its middle by more than max_regular_change.
  bent,
  //! A critical curve may run through it: a star may have several images of any brightness.
  folded
};

//! Upper limit of the relative deviation of a regular patch's Jacobian from that at its middle.
inline constexpr float max_regular_change = 0.6F;

inline namespace ERGO_TARGET {

ERGO_HD Vector3<double> control_point(const BezierPatch& patch, int i) {
  return {static_cast<double>(patch.x[i]), static_cast<double>(patch.y[i]), static_cast<double>(patch.z[i])};
}

//! Returns the Bézier patch of a leaf of a lens grid: the sky direction, before normalization, as a
//! function of (u, v) along (γ, s).
ERGO_HD BezierPatch bezier_patch(const LensGrid& grid, int leaf, float width_turns, float height) {
  BezierPatch patch{};
  float* const parts[3] = {patch.x, patch.y, patch.z};
  for (int corner = 0; corner < 4; ++corner) {
    const float* node = grid.nodes + floats_a_node * grid.leaves[4 * leaf + corner];
    const int column = corner & 1;
    const int row = corner >> 1;
    // Steps from each corner inwards to the next control points: a third of the derivative along γ
    // or s, times the side of the leaf along it.
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

namespace detail {
//! Halves each of the four rows (axis 0) or columns (axis 1) of control points by de Casteljau's
//! construction.
template <class T>
ERGO_HD void split_points(const T (&from)[16], int axis, T (&first)[16], T (&second)[16]) {
  const int along = axis == 0 ? 1 : 4;
  const int across = axis == 0 ? 4 : 1;
  for (int line = 0; line < 4; ++line) {
    const int at = line * across;
    const T a = from[at];
    const T b = from[at + along];
    const T c = from[at + 2 * along];
    const T d = from[at + 3 * along];
    const T ab = 0.5F * (a + b);
    const T bc = 0.5F * (b + c);
    const T cd = 0.5F * (c + d);
    const T abc = 0.5F * (ab + bc);
    const T bcd = 0.5F * (bc + cd);
    const T middle = 0.5F * (abc + bcd);
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

//! Computes the cubic Bernstein polynomials at t and their derivatives by t.
template <class T>
ERGO_HD void bernstein(const T& t, T (&basis)[4], T (&slope)[4]) {
  const T r = T(1.0F) - t;
  const T r2 = r * r;
  const T t2 = t * t;
  const T rt = r * t;
  basis[0] = r2 * r;
  basis[1] = 3.0F * r2 * t;
  basis[2] = 3.0F * r * t2;
  basis[3] = t2 * t;
  slope[0] = -3.0F * r2;
  slope[1] = 3.0F * r2 - 6.0F * rt;
  slope[2] = 6.0F * rt - 3.0F * t2;
  slope[3] = 3.0F * t2;
}

template <class T>
struct FormValue {
  T value, by_u, by_v;
};

//! Evaluates one coordinate of a patch with its derivatives by u and v. Sums along v first, so that
//! four columns are summed at a time.
template <class T, class Point>
ERGO_HD FormValue<T> form_at(const Point (&points)[16], const T (&along_u)[4], const T (&slope_u)[4],
                             const T (&along_v)[4], const T (&slope_v)[4]) {
  T sum[4];
  T slope[4];
  ERGO_UNROLL
  for (int column = 0; column < 4; ++column) {
    sum[column] = along_v[0] * points[column];
    slope[column] = slope_v[0] * points[column];
  }
  ERGO_UNROLL
  for (int row = 1; row < 4; ++row) {
    ERGO_UNROLL
    for (int column = 0; column < 4; ++column) {
      sum[column] = sum[column] + along_v[row] * points[4 * row + column];
      slope[column] = slope[column] + slope_v[row] * points[4 * row + column];
    }
  }
  const auto total = [](const T(&a)[4], const T(&b)[4]) {
    return (a[0] * b[0] + a[1] * b[1]) + (a[2] * b[2] + a[3] * b[3]);
  };
  return {total(sum, along_u), total(sum, slope_u), total(slope, along_u)};
}
}  // namespace detail

//! Splits a patch into its parts below and above the middle of u (axis 0) or v (axis 1).
ERGO_HD void split(const BezierPatch& patch, int axis, BezierPatch& first, BezierPatch& second) {
  detail::split_points(patch.x, axis, first.x, second.x);
  detail::split_points(patch.y, axis, first.y, second.y);
  detail::split_points(patch.z, axis, first.z, second.z);
}

//! Offset (p, q) of a point of a patch from a star, with derivatives along u and v; p = q = 0 at an
//! image of the star.
template <class T>
struct PlaneValue {
  T p, q;
  T p_u, q_u;
  T p_v, q_v;
};

template <class T>
ERGO_HD T determinant(const PlaneValue<T>& f) {
  return f.p_u * f.q_v - f.p_v * f.q_u;
}

//! Evaluates a patch at (u, v), which may lie outside [0, 1]², as seen from a star at (a, b) in the
//! plane z = 1: p = x - a z, q = y - b z.
template <class T>
ERGO_HD PlaneValue<T> seen_from(const BezierPatch& patch, const T& a, const T& b, const T& u, const T& v) {
  T along_u[4];
  T slope_u[4];
  T along_v[4];
  T slope_v[4];
  detail::bernstein(u, along_u, slope_u);
  detail::bernstein(v, along_v, slope_v);
  const detail::FormValue<T> x = detail::form_at(patch.x, along_u, slope_u, along_v, slope_v);
  const detail::FormValue<T> y = detail::form_at(patch.y, along_u, slope_u, along_v, slope_v);
  const detail::FormValue<T> z = detail::form_at(patch.z, along_u, slope_u, along_v, slope_v);
  return {x.value - a * z.value, y.value - b * z.value, x.by_u - a * z.by_u,
          y.by_u - b * z.by_u,   x.by_v - a * z.by_v,   y.by_v - b * z.by_v};
}

namespace detail {
//! Returns the largest relative deviation of a patch's derivatives along one axis from those at its
//! middle. `step`: index distance of neighboring control points along the axis; `last`: bit mask of
//! control points without a next neighbor; T: a SIMD pack whose lanes are control points.
template <class T>
ERGO_HD float derivative_change(const BezierPatch& patch, const PlaneValue<float>& middle, int step, unsigned last) {
  constexpr int lanes = RealTraits<T>::lane_count;
  const float scale = 3.0F / determinant(middle);
  const T unit_u(step == 1 ? 1.0F : 0.0F);
  const T unit_v(step == 1 ? 0.0F : 1.0F);
  T largest(0.0F);
  for (int i = 0; i < 16; i += lanes) {
    const auto difference = [&](const float(&points)[16]) {
      float next[lanes];
      for (int k = 0; k < lanes; ++k) {
        next[k] = points[i + k + step < 16 ? i + k + step : 15];
      }
      return load_lanes<T>(next, 0, lanes) - load_lanes<T>(points, i, 16);
    };
    const T dp = difference(patch.x);
    const T dq = difference(patch.y);
    // J⁻¹ times the control points of the derivative by u or v, minus the unit vector that it
    // equals in an affine map.
    const T change = maximum(absolute((middle.q_v * dp - middle.p_v * dq) * scale - unit_u),
                             absolute((middle.p_u * dq - middle.q_u * dp) * scale - unit_v));
    largest = maximum(largest, select(mask_from_bits<T>(~last >> static_cast<unsigned>(i)), change, T(0.0F)));
  }
  float max_value = 0.0F;
  for (int k = 0; k < lanes; ++k) {
    max_value = maximum(max_value, lane(largest, k));
  }
  return max_value;
}
}  // namespace detail

//! Returns whether the Jacobian of a patch, seen from its axis, is nearly constant. Such a patch is
//! one to one, and Newton's method from its middle converges to a star's image. T: a number or a
//! SIMD pack.
template <class T>
ERGO_HD bool is_regular(const BezierPatch& patch) {
  constexpr unsigned last_column = 0x8888U;
  constexpr unsigned last_row = 0xF000U;
  const PlaneValue<float> middle = seen_from(patch, 0.0F, 0.0F, 0.5F, 0.5F);
  return detail::derivative_change<T>(patch, middle, 1, last_column) +
             detail::derivative_change<T>(patch, middle, 4, last_row) <
         max_regular_change;
}

}  // namespace ERGO_TARGET
}  // namespace ergodome
