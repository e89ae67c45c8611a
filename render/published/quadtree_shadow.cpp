#include <algorithm>
#include <cmath>

#include "kernels/core/angles.h"
#include "kernels/spacetime/shadow/critical_curve.h"
#include "render/published/quadtree_builder.h"

namespace ergodome {

namespace {

constexpr int table_size = 1024;

struct EdgePoint {
  double row;
  double column;
};

//! Returns the edge in rows and columns, without a jump where the columns wrap around.
std::vector<EdgePoint> edge_points_of(const CameraStation& camera, int level) {
  const ShadowChart chart = make_shadow_chart(camera);
  const double columns = 2 << level;
  std::vector<EdgePoint> points;
  for (int i = 0; i < table_size; ++i) {
    const double gamma = full_turn * i / table_size;
    const double alpha = edge_polar_angle(camera, chart, gamma);
    float row = 0.0F;
    float column = 0.0F;
    quadtree_place(level, chart_direction<double>(chart, std::cos(alpha), std::sin(alpha), gamma), row, column);
    EdgePoint point = {static_cast<double>(row), static_cast<double>(column)};
    if (!points.empty()) {
      point.column = points.back().column + std::remainder(point.column - points.back().column, columns);
    }
    points.push_back(point);
  }
  return points;
}

}  // namespace

QuadtreeShadowTable::QuadtreeShadowTable(const CameraStation& camera, int level) : radius_(table_size, 0.0F) {
  const std::vector<EdgePoint> points = edge_points_of(camera, level);
  double row = 0.0;
  double column = 0.0;
  for (const EdgePoint& point : points) {
    row += point.row / table_size;
    column += point.column / table_size;
  }
  row_ = static_cast<float>(row);
  column_ = static_cast<float>(column);
  // Each direction from the center meets the edge once; between neighboring points the distance is
  // interpolated linearly in the angle.
  for (int i = 0; i < table_size; ++i) {
    const EdgePoint& a = points[static_cast<std::size_t>(i)];
    const EdgePoint& b = points[static_cast<std::size_t>((i + 1) % table_size)];
    const double from = std::atan2(a.row - row, a.column - column);
    const double turn = std::remainder(std::atan2(b.row - row, b.column - column) - from, full_turn);
    const double begin = std::hypot(a.row - row, a.column - column);
    const double end = std::hypot(b.row - row, b.column - column);
    const double low = std::min(from, from + turn) / full_turn * table_size;
    const double high = std::max(from, from + turn) / full_turn * table_size;
    for (int at = static_cast<int>(std::ceil(low)); at <= high; ++at) {
      const double t = std::abs(turn) > 0.0 ? (at * full_turn / table_size - from) / turn : 0.0;
      radius_[static_cast<std::size_t>((at % table_size + table_size) % table_size)] =
          static_cast<float>(begin + t * (end - begin));
    }
  }
}

QuadtreeShadow QuadtreeShadowTable::view() const { return {row_, column_, radius_.data(), table_size}; }

QuadtreeLookUp look_up_of(const QuadtreeGrid& grid, QuadtreeInterpolation how) { return {{grid, grid}, {}, 0.0F, how}; }

}  // namespace ergodome
