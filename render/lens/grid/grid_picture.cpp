#include "render/lens/grid/grid_picture.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "kernels/core/angles.h"
#include "kernels/image/color_map.h"
#include "kernels/launch/parallel_for.h"

namespace ergodome {

namespace {

using CellDual = Dual<float>;

//! Returns the direction of a pixel of the picture, with derivatives per pixel. Its angle α from
//! the shadow's center is proportional to the pixel's distance from the middle of the picture.
Vector3<CellDual> direction_at(const EdgeCurve& edge, int x, int y, int size_px) {
  const float scale = 2.0F * static_cast<float>(pi) / static_cast<float>(size_px);
  const CellDual along_first((static_cast<float>(x) + 0.5F) * scale - static_cast<float>(pi), scale, 0.0F);
  const CellDual along_second((static_cast<float>(y) + 0.5F) * scale - static_cast<float>(pi), 0.0F, scale);
  const CellDual alpha = sqrt(along_first * along_first + along_second * along_second + CellDual(1e-12F));
  CellDual sine;
  CellDual cosine;
  sine_cosine(alpha, sine, cosine);
  const CellDual part = sine / alpha;
  const auto component = [&](float c, float f, float s) {
    return cosine * c + part * (along_first * f + along_second * s);
  };
  return {component(edge.centre.x, edge.first.x, edge.second.x), component(edge.centre.y, edge.first.y, edge.second.y),
          component(edge.centre.z, edge.first.z, edge.second.z)};
}

//! Returns the fraction of a pixel that is covered by lines at 0 and 1 of a coordinate in [0, 1],
//! which changes by `per_pixel` per pixel.
float line(float coordinate, float per_pixel) {
  const float distance_px = std::min(coordinate, 1.0F - coordinate) / std::max(per_pixel, 1e-9F);
  // Fades out lines that are only a few pixels apart, which would cover everything.
  return std::clamp(1.0F - distance_px, 0.0F, 1.0F) * std::clamp(0.25F / std::max(per_pixel, 1e-9F) - 0.5F, 0.0F, 1.0F);
}

Vector3<float> colour_at(const LensStation& station, const LensGrid& grid, const Vector3<CellDual>& n,
                         double budget_px) {
  const ChartPosition<CellDual> position = chart_position(grid.chart, n);
  if (position.edge_distance.value <= 0.0F) {
    return {0.0F, 0.0F, 0.0F};
  }
  const float turns = position.gamma_turns.value;
  const float half_turns = grid.mirrored != 0 && turns > 0.5F ? 1.0F - turns : turns;
  const Leaf leaf = find_leaf(grid, half_turns, position.s.value);
  const LeafPosition at = position_in(leaf, half_turns, position.s.value);
  const float error = station.leaf_error_px[static_cast<std::size_t>(leaf.number)] / static_cast<float>(budget_px);
  Vector3<float> colour = leaf.flagged ? Vector3<float>{0.75F, 0.10F, 0.12F} : heat_color(error);
  const float across = std::hypot(position.gamma_turns.along_x, position.gamma_turns.along_y) / leaf.width_turns;
  const float along = std::hypot(position.s.along_x, position.s.along_y) / leaf.height;
  const float drawn = 0.7F * std::max(line(at.u, across), line(at.v, along));
  return (1.0F - drawn) * colour + drawn * Vector3<float>{1.0F, 1.0F, 1.0F};
}

}  // namespace

std::vector<GridLevel> grid_levels(const LensStation& station) {
  std::map<int, GridLevel> levels;
  const std::vector<bool> flagged = flagged_leaves(station);
  // Entries of the tree that are still to be visited, with their depth below the root.
  std::vector<std::pair<int, int>> open;
  open.reserve(static_cast<std::size_t>(station.columns) * static_cast<std::size_t>(station.rows));
  for (int root = 0; root < station.columns * station.rows; ++root) {
    open.emplace_back(root, 0);
  }
  while (!open.empty()) {
    const auto [slot, depth] = open.back();
    open.pop_back();
    const int entry = station.tree[static_cast<std::size_t>(slot)];
    if (entry >= 0) {
      open.emplace_back(entry >> 1, depth + 1);
      open.emplace_back((entry >> 1) + 1, depth + 1);
      continue;
    }
    GridLevel& level = levels[depth];
    level.halvings = depth;
    ++level.leaves;
    level.flagged += flagged[static_cast<std::size_t>((-1 - entry) >> 1)] ? 1 : 0;
  }
  std::vector<GridLevel> list;
  list.reserve(levels.size());
  for (const auto& [depth, level] : levels) {
    list.push_back(level);
  }
  return list;
}

std::vector<std::uint8_t> draw_grid(const LensStation& station, int size_px, double budget_px) {
  const LensGrid grid = grid_view(station);
  std::vector<std::uint8_t> rgb(3 * static_cast<std::size_t>(size_px) * static_cast<std::size_t>(size_px), 0);
  parallel_for(size_px, 8, [&](int begin, int end) {
    for (int y = begin; y < end; ++y) {
      for (int x = 0; x < size_px; ++x) {
        const float half = 0.5F * static_cast<float>(size_px);
        if (std::hypot(static_cast<float>(x) + 0.5F - half, static_cast<float>(y) + 0.5F - half) >= half) {
          continue;
        }
        const Vector3<float> colour = colour_at(station, grid, direction_at(grid.chart.edge, x, y, size_px), budget_px);
        std::uint8_t* to = rgb.data() + 3 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(size_px) +
                                             static_cast<std::size_t>(x));
        const float parts[3] = {colour.x, colour.y, colour.z};
        for (int c = 0; c < 3; ++c) {
          to[c] = static_cast<std::uint8_t>(std::lround(255.0F * std::clamp(parts[c], 0.0F, 1.0F)));
        }
      }
    }
  });
  return rgb;
}

}  // namespace ergodome
