#include "calibration/warps/warp_thinning.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "calibration/warps/warp_conversion.h"

namespace ergodome {

namespace {

struct MasterPosition {
  double u = 0.0;
  double v = 0.0;
};

MasterPosition operator-(const MasterPosition& a, const MasterPosition& b) { return {a.u - b.u, a.v - b.v}; }

//! Returns a + s (b - a) + t (c - a).
MasterPosition between(const MasterPosition& a, const MasterPosition& b, const MasterPosition& c, double s, double t) {
  return {a.u + s * (b.u - a.u) + t * (c.u - a.u), a.v + s * (b.v - a.v) + t * (c.v - a.v)};
}

//! The four samples of a map around a pixel, and the pixel's position between them: 0 to 1, or
//! beyond at the raster's edge.
struct Cell {
  MasterPosition top_left;
  MasterPosition top_right;
  MasterPosition bottom_left;
  MasterPosition bottom_right;
  double x = 0.0;
  double y = 0.0;

  [[nodiscard]] MasterPosition bilinear() const {
    const MasterPosition top = between(top_left, top_right, top_left, x, 0.0);
    const MasterPosition bottom = between(bottom_left, bottom_right, bottom_left, x, 0.0);
    return between(top, bottom, top, y, 0.0);
  }
  //! Interpolates in one of the two triangles into which the diagonal from the top left divides the
  //! cell.
  [[nodiscard]] MasterPosition triangular() const {
    return x >= y ? between(top_right, top_left, bottom_right, 1.0 - x, y)
                  : between(bottom_left, bottom_right, top_left, x, 1.0 - y);
  }
};

Cell cell_of(const FloatMap& map, double x, double y) {
  const double column = x * map.width - 0.5;
  const double row = y * map.height - 0.5;
  const int left = std::clamp(static_cast<int>(std::floor(column)), 0, map.width - 2);
  const int top = std::clamp(static_cast<int>(std::floor(row)), 0, map.height - 2);
  const auto sample = [&](int i, int j) {
    const std::size_t first =
        3 * (static_cast<std::size_t>(j) * static_cast<std::size_t>(map.width) + static_cast<std::size_t>(i));
    return MasterPosition{map.samples[first], map.samples[first + 1]};
  };
  return {sample(left, top),         sample(left + 1, top), sample(left, top + 1),
          sample(left + 1, top + 1), column - left,         row - top};
}

bool sees_master(const WarpNode& node) { return node.valid && std::hypot(node.u - 0.5F, node.v - 0.5F) <= 0.5F; }

//! Returns the derivative of a warp per pixel along one axis, at a pixel: from both neighbors if
//! they are drawn, otherwise from the pixel and the drawn neighbor.
MasterPosition slope_at(const WarpMesh& exact, int column, int row, int right, int down) {
  const auto position = [](const WarpNode& node) { return MasterPosition{node.u, node.v}; };
  int from = 0;
  int to = 0;
  const auto drawn = [&](int steps) {
    const int i = column + steps * right;
    const int j = row + steps * down;
    return i >= 0 && j >= 0 && i < exact.columns && j < exact.rows && exact.at(i, j).valid;
  };
  from = drawn(-1) ? -1 : 0;
  to = drawn(1) ? 1 : 0;
  const MasterPosition change = position(exact.at(column + to * right, row + to * down)) -
                                position(exact.at(column + from * right, row + from * down));
  const int steps = std::max(to - from, 1);
  return {change.u / steps, change.v / steps};
}

//! Converts a displacement in the domemaster to pixels of the raster.
double in_pixels(const WarpMesh& exact, int column, int row, const MasterPosition& error) {
  const MasterPosition along_x = slope_at(exact, column, row, 1, 0);
  const MasterPosition along_y = slope_at(exact, column, row, 0, 1);
  const double area = along_x.u * along_y.v - along_x.v * along_y.u;
  const double x = error.u * along_y.v - error.v * along_y.u;
  const double y = error.v * along_x.u - error.u * along_x.v;
  return area == 0.0 ? std::numeric_limits<double>::infinity() : std::hypot(x, y) / std::abs(area);
}

}  // namespace

double map_error_px(const WarpMesh& exact, const FloatMap& map, double enough_px) {
  double worst = 0.0;
  for (int row = 0; row < exact.rows; ++row) {
    for (int column = 0; column < exact.columns; ++column) {
      const WarpNode& node = exact.at(column, row);
      if (!sees_master(node)) {
        continue;
      }
      const Cell cell = cell_of(map, fill_position(column, exact.columns), fill_position(row, exact.rows));
      const MasterPosition position = {node.u, node.v};
      for (const MasterPosition& read : {cell.bilinear(), cell.triangular()}) {
        const double error = in_pixels(exact, column, row, read - position);
        if (!(error <= enough_px)) {
          return std::isnan(error) ? std::numeric_limits<double>::infinity() : error;
        }
        worst = std::max(worst, error);
      }
    }
  }
  return worst;
}

FloatMap thinned_map(const WarpMesh& warp, const WarpMesh& exact) {
  for (const int pixels : {8, 4, 2}) {
    const auto samples = [&](int side) { return std::max(2, (side + pixels - 1) / pixels); };
    FloatMap map = map_from_warp(warp, samples(exact.columns), samples(exact.rows), TextureDirection::downwards);
    if (map_error_px(exact, map, thinned_error_px) <= thinned_error_px) {
      return map;
    }
  }
  return map_from_warp(exact, exact.columns, exact.rows, TextureDirection::downwards);
}

}  // namespace ergodome
