#pragma once

#include <cstdint>

#include "kernels/core/arithmetic.h"
#include "kernels/core/vector3.h"
#include "kernels/spacetime/kerr/camera_station.h"

// The adaptive grid of Verbraeck & Eisemann (IEEE TVCG 27, 2021; "VE"), section 4.3: the baseline
// of every comparison.
namespace ergodome {

//! A position on the celestial sky or on the camera's, in VE's form: two angles [rad]. A negative
//! theta means that the direction is in the shadow.
struct SkyAngles {
  float theta;
  float phi;
};

//! An entry of the hash table, a vertex: its position on the camera's sky, and the source of its
//! light.
struct QuadtreeVertex {
  std::int32_t row;  //!< -1: the slot is free
  std::int32_t column;
  SkyAngles sky;
};

//! Interpolation of a quadtree grid between its vertices.
enum class QuadtreeInterpolation : std::int32_t { linear, spline };

//! VE's grid as kernels read it: an equirectangular camera sky, divided into two square root cells
//! of half the sky each, and an implicit quadtree in each: a cell is split if its center is a
//! vertex.
//!
//! Row i is the polar angle π i / 2^level from -e_θ ("up"), column j the azimuth 2π j / 2^(level +
//! 1) from +e_φ towards +e_r, of the finest possible grid (VE, eq. 1). Vertices are found through a
//! hash whose slots contain their key.
struct QuadtreeGrid {
  const QuadtreeVertex* slots;
  std::uint32_t mask;  //!< number of slots - 1; the number of slots is a power of two
  int level;           //!< finest level, L_max
  int mirrored;        //!< 1: rows beyond the equator mirror those before it
};

//! A cell: its first row and column, and its width, in units of the finest cells.
struct QuadtreeCell {
  int row;
  int column;
  int width;
};

inline namespace ERGO_TARGET {

ERGO_HD bool in_shadow(const SkyAngles& s) { return s.theta < 0.0F; }

ERGO_HD SkyAngles shadow_angles() { return {-1.0F, -1.0F}; }

//! Returns the first slot to check for a vertex; the next ones follow in turn.
ERGO_HD std::uint32_t quadtree_hash(int row, int column) {
  std::uint32_t h = static_cast<std::uint32_t>(row) * 0x9e3779b1U ^ static_cast<std::uint32_t>(column) * 0x85ebca77U;
  h ^= h >> 15U;
  return h * 0x2c1b3c6dU;
}

//! Looks up a vertex; row and column must be in range. Returns false if there is none.
ERGO_HD bool find_vertex(const QuadtreeGrid& grid, int row, int column, SkyAngles& sky) {
  std::uint32_t slot = quadtree_hash(row, column) & grid.mask;
  while (grid.slots[slot].row >= 0) {
    if (grid.slots[slot].row == row && grid.slots[slot].column == column) {
      sky = grid.slots[slot].sky;
      return true;
    }
    slot = (slot + 1) & grid.mask;
  }
  return false;
}

namespace detail {
constexpr float sky_pi = 3.14159265358979F;

//! Looks up a vertex at any row and column: columns wrap around, rows continue behind the poles,
//! and the lower half of a mirrored grid is read from its upper half.
ERGO_HD bool find_any_vertex(const QuadtreeGrid& grid, int row, int column, SkyAngles& sky) {
  const int rows = 1 << grid.level;
  const int columns = 2 * rows;
  if (row < 0 || row > rows) {
    row = row < 0 ? -row : 2 * rows - row;
    column += rows;
  }
  column = ((column % columns) + columns) % columns;
  const bool lower = grid.mirrored != 0 && row > rows / 2;
  if (!find_vertex(grid, lower ? rows - row : row, column, sky)) {
    return false;
  }
  if (lower && !in_shadow(sky)) {
    sky.theta = sky_pi - sky.theta;
  }
  return true;
}

//! Returns b with its azimuth changed by a multiple of 2π, so that it is within π of that of a.
ERGO_HD SkyAngles beside(const SkyAngles& a, SkyAngles b) {
  b.phi += b.phi - a.phi > sky_pi ? -2.0F * sky_pi : (a.phi - b.phi > sky_pi ? 2.0F * sky_pi : 0.0F);
  return b;
}

ERGO_HD SkyAngles mixed(const SkyAngles& a, const SkyAngles& b, float t) {
  if (in_shadow(a) || in_shadow(b)) {
    return shadow_angles();
  }
  const SkyAngles c = beside(a, b);
  return {a.theta + t * (c.theta - a.theta), a.phi + t * (c.phi - a.phi)};
}

//! Interpolates by a cubic Hermite spline from q1 to q2, with tangents from the ends q0 and q3 (VE,
//! eq. 2); linear where an end is in the shadow.
ERGO_HD SkyAngles spline(const SkyAngles& q0, const SkyAngles& q1, const SkyAngles& q2, const SkyAngles& q3, float t) {
  if (in_shadow(q0) || in_shadow(q3)) {
    return mixed(q1, q2, t);
  }
  if (in_shadow(q1) || in_shadow(q2)) {
    return shadow_angles();
  }
  const SkyAngles a = beside(q1, q0);
  const SkyAngles c = beside(q1, q2);
  const SkyAngles d = beside(c, q3);
  const float t2 = t * t;
  const float t3 = t2 * t;
  const float h01 = 3.0F * t2 - 2.0F * t3;
  const float h10 = t3 - 2.0F * t2 + t;
  const float h11 = t3 - t2;
  return {(1.0F - h01) * q1.theta + h01 * c.theta + 0.5F * (h10 * (c.theta - a.theta) + h11 * (d.theta - q1.theta)),
          (1.0F - h01) * q1.phi + h01 * c.phi + 0.5F * (h10 * (c.phi - a.phi) + h11 * (d.phi - q1.phi))};
}

//! Corners of a leaf: upper left and right, lower left and right.
struct QuadtreeCorners {
  SkyAngles upper_left;
  SkyAngles upper_right;
  SkyAngles lower_left;
  SkyAngles lower_right;
};

ERGO_HD QuadtreeCorners corners_of(const QuadtreeGrid& grid, const QuadtreeCell& c) {
  // A corner without a vertex is in the shadow.
  const auto vertex = [&](int row, int column) {
    SkyAngles sky{};
    return find_any_vertex(grid, row, column, sky) ? sky : shadow_angles();
  };
  return {vertex(c.row, c.column), vertex(c.row, c.column + c.width), vertex(c.row + c.width, c.column),
          vertex(c.row + c.width, c.column + c.width)};
}
}  // namespace detail

//! Returns the leaf that contains a position (row, column), in finest cells and within the sky.
ERGO_HD QuadtreeCell find_quadtree_leaf(const QuadtreeGrid& grid, float row, float column) {
  const int rows = 1 << grid.level;
  QuadtreeCell cell = {0, column < static_cast<float>(rows) ? 0 : rows, rows};
  SkyAngles middle{};
  while (cell.width > 1 &&
         detail::find_any_vertex(grid, cell.row + cell.width / 2, cell.column + cell.width / 2, middle)) {
    cell.width /= 2;
    cell.row += row >= static_cast<float>(cell.row + cell.width) ? cell.width : 0;
    cell.column += column >= static_cast<float>(cell.column + cell.width) ? cell.width : 0;
  }
  return cell;
}

//! Interpolates bilinearly (VE, eq. 3) at a position in finest cells. Returns the shadow if a
//! corner is in it.
ERGO_HD SkyAngles read_quadtree_linear(const QuadtreeGrid& grid, float row, float column) {
  const QuadtreeCell cell = find_quadtree_leaf(grid, row, column);
  const float across = (column - static_cast<float>(cell.column)) / static_cast<float>(cell.width);
  const float down = (row - static_cast<float>(cell.row)) / static_cast<float>(cell.width);
  const detail::QuadtreeCorners c = detail::corners_of(grid, cell);
  return detail::mixed(detail::mixed(c.upper_left, c.upper_right, across),
                       detail::mixed(c.lower_left, c.lower_right, across), down);
}

namespace detail {
//! Wraps a grid position into the sky, as find_any_vertex() does for vertices.
ERGO_HD void into_sky(const QuadtreeGrid& grid, int& row, int& column) {
  const int rows = 1 << grid.level;
  if (row < 0 || row > rows) {
    row = row < 0 ? -row : 2 * rows - row;
    column += rows;
  }
  column = ((column % (2 * rows)) + 2 * rows) % (2 * rows);
}

//! Interpolates by splines in a leaf; `end` returns the sky at grid positions outside it.
template <class End>
ERGO_HD SkyAngles spline_in_leaf(const QuadtreeGrid& grid, const QuadtreeCell& cell, float across, float down,
                                 const End& end) {
  const int w = cell.width;
  const QuadtreeCorners c = corners_of(grid, cell);
  const int left = cell.column - w;
  const int right = cell.column + 2 * w;
  const SkyAngles upper = spline(end(cell.row, left), c.upper_left, c.upper_right, end(cell.row, right), across);
  const SkyAngles lower =
      spline(end(cell.row + w, left), c.lower_left, c.lower_right, end(cell.row + w, right), across);
  const SkyAngles above = mixed(end(cell.row - w, cell.column), end(cell.row - w, cell.column + w), across);
  const SkyAngles below = mixed(end(cell.row + 2 * w, cell.column), end(cell.row + 2 * w, cell.column + w), across);
  return spline(above, upper, lower, below, down);
}

//! The sky at a grid position: its vertex, or the bilinear interpolation there.
struct LinearEnd {
  const QuadtreeGrid& grid;

  ERGO_HD SkyAngles operator()(int row, int column) const {
    SkyAngles sky{};
    if (find_any_vertex(grid, row, column, sky)) {
      return sky;
    }
    into_sky(grid, row, column);
    return read_quadtree_linear(grid, static_cast<float>(row), static_cast<float>(column));
  }
};

//! The sky at a grid position: its vertex, or splines whose missing ends are linear ("to avoid a
//! long chain of recursive calls").
struct SplineEnd {
  const QuadtreeGrid& grid;

  ERGO_HD SkyAngles operator()(int row, int column) const {
    SkyAngles sky{};
    if (find_any_vertex(grid, row, column, sky)) {
      return sky;
    }
    into_sky(grid, row, column);
    const QuadtreeCell cell = find_quadtree_leaf(grid, static_cast<float>(row), static_cast<float>(column));
    const auto width = static_cast<float>(cell.width);
    return spline_in_leaf(grid, cell, static_cast<float>(column - cell.column) / width,
                          static_cast<float>(row - cell.row) / width, LinearEnd{grid});
  }
};
}  // namespace detail

//! Interpolates by Hermite splines (VE, section 4.3.2) at a position in finest cells.
ERGO_HD SkyAngles read_quadtree_spline(const QuadtreeGrid& grid, float row, float column) {
  const QuadtreeCell cell = find_quadtree_leaf(grid, row, column);
  const auto width = static_cast<float>(cell.width);
  return detail::spline_in_leaf(grid, cell, (column - static_cast<float>(cell.column)) / width,
                                (row - static_cast<float>(cell.row)) / width, detail::SplineEnd{grid});
}

//! Returns the camera direction of a grid position (row and column in finest cells). The inverse is
//! quadtree_position().
ERGO_HD Vector3<double> quadtree_direction(int level, double row, double column) {
  const double step = 3.14159265358979323846 / static_cast<double>(1 << level);
  const double sine = ::sin(row * step);
  return {sine * ::sin(column * step), -::cos(row * step), sine * ::cos(column * step)};
}

ERGO_HD void quadtree_position(int level, const Vector3<double>& n, float& row, float& column) {
  const double per_radian = static_cast<double>(1 << level) / 3.14159265358979323846;
  const double azimuth = ::atan2(n.x, n.z);
  row = static_cast<float>(::atan2(::sqrt(n.x * n.x + n.z * n.z), -n.y) * per_radian);
  column = static_cast<float>((azimuth < 0.0 ? azimuth + 6.28318530717958647692 : azimuth) * per_radian);
}

ERGO_HD_CALLED SkyAngles read_quadtree(const QuadtreeGrid& grid, QuadtreeInterpolation how, float row, float column) {
  return how == QuadtreeInterpolation::linear ? read_quadtree_linear(grid, row, column)
                                              : read_quadtree_spline(grid, row, column);
}

}  // namespace ERGO_TARGET
}  // namespace ergodome
