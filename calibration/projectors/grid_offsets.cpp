#include "calibration/projectors/grid_offsets.h"

#include <algorithm>
#include <cmath>

namespace ergodome {

namespace {

//! Returns the offset at a position, bilinear between the four points around it.
double between(const GridOffsets& grid, const std::vector<double>& offsets, const RasterPosition& position) {
  const int cells = grid.points - 1;
  const double x = std::clamp(position.x, 0.0, 1.0) * cells;
  const double y = std::clamp(position.y, 0.0, 1.0) * cells;
  const int column = std::min(static_cast<int>(x), cells - 1);
  const int row = std::min(static_cast<int>(y), cells - 1);
  const double across = x - column;
  const double down = y - row;
  const auto at = [&](int i, int j) { return offsets[grid.index(column + i, row + j)]; };
  return std::lerp(std::lerp(at(0, 0), at(1, 0), across), std::lerp(at(0, 1), at(1, 1), across), down);
}

//! Clamps a new offset of a point, first to the range of `farthest`, then so that its difference
//! from the offsets of the up to eight neighbors is at most the slack.
double clamped(const GridOffsets& grid, const std::vector<double>& offsets, std::size_t point, double offset) {
  const double slack = GridOffsets::slack / (grid.points - 1);
  const int column = static_cast<int>(point) % grid.points;
  const int row = static_cast<int>(point) / grid.points;
  double minimum = -GridOffsets::farthest;
  double maximum = GridOffsets::farthest;
  for (int j = std::max(row - 1, 0); j <= std::min(row + 1, grid.points - 1); ++j) {
    for (int i = std::max(column - 1, 0); i <= std::min(column + 1, grid.points - 1); ++i) {
      if (i == column && j == row) {
        continue;
      }
      const double neighbor = offsets[grid.index(i, j)];
      minimum = std::max(minimum, neighbor - slack);
      maximum = std::min(maximum, neighbor + slack);
    }
  }
  return std::clamp(offset, minimum, std::max(minimum, maximum));
}

//! Returns a channel of a mask at a position, bilinear between its samples, which fill the raster.
float read(const BlendMap& mask, const RasterPosition& position, int channel) {
  const double x = std::clamp(position.x * mask.width - 0.5, 0.0, mask.width - 1.0);
  const double y = std::clamp(position.y * mask.height - 0.5, 0.0, mask.height - 1.0);
  const int left = std::min(static_cast<int>(x), mask.width - 2);
  const int top = std::min(static_cast<int>(y), mask.height - 2);
  const auto at = [&](int column, int row) {
    const std::size_t pixel =
        static_cast<std::size_t>(row) * static_cast<std::size_t>(mask.width) + static_cast<std::size_t>(column);
    return static_cast<double>(
        mask.values[static_cast<std::size_t>(mask.channels) * pixel + static_cast<std::size_t>(channel)]);
  };
  return static_cast<float>(std::lerp(std::lerp(at(left, top), at(left + 1, top), x - left),
                                      std::lerp(at(left, top + 1), at(left + 1, top + 1), x - left), y - top));
}

//! Returns the node at a position between nodes, on the two triangles of a cell.
WarpNode node_between(const WarpMesh& mesh, double column, double row) {
  const int left = std::min(static_cast<int>(column), mesh.columns - 2);
  const int top = std::min(static_cast<int>(row), mesh.rows - 2);
  const auto across = static_cast<float>(column - left);
  const auto down = static_cast<float>(row - top);
  const WarpNode& a = mesh.at(left, top);
  const WarpNode& b = across >= down ? mesh.at(left + 1, top) : mesh.at(left, top + 1);
  const WarpNode& c = mesh.at(left + 1, top + 1);
  // Weights of a, b and c for a position that is reached by going along the triangle's side from a
  // to b, then along that from b to c.
  const float first = std::max(across, down);
  const float second = std::min(across, down);
  const float weights[] = {1.0F - first, first - second, second};
  const WarpNode* const nodes[] = {&a, &b, &c};
  // Excludes nodes of weight 0, which may contain any values, even NaN.
  const auto mix = [&](float WarpNode::*value) {
    float sum = 0.0F;
    for (int i = 0; i < 3; ++i) {
      sum += weights[i] > 0.0F ? weights[i] * nodes[i]->*value : 0.0F;
    }
    return sum;
  };
  WarpNode node;
  node.x = mix(&WarpNode::x);
  node.y = mix(&WarpNode::y);
  node.u = mix(&WarpNode::u);
  node.v = mix(&WarpNode::v);
  node.intensity = mix(&WarpNode::intensity);
  for (int i = 0; i < 3; ++i) {
    node.valid = node.valid && (weights[i] <= 0.0F || nodes[i]->valid);
  }
  return node;
}

}  // namespace

bool GridOffsets::none() const {
  const auto zero = [](double offset) { return offset == 0.0; };
  return std::ranges::all_of(right, zero) && std::ranges::all_of(down, zero);
}

void GridOffsets::move(std::size_t point, double new_right, double new_down) {
  right[point] = clamped(*this, right, point, new_right);
  down[point] = clamped(*this, down, point, new_down);
}

GridOffsets GridOffsets::resized(int new_points) const {
  GridOffsets grid;
  grid.points = new_points;
  grid.right.clear();
  grid.down.clear();
  for (int row = 0; row < new_points; ++row) {
    for (int column = 0; column < new_points; ++column) {
      const RasterPosition position = {column / (new_points - 1.0), row / (new_points - 1.0)};
      grid.right.push_back(between(*this, right, position));
      grid.down.push_back(between(*this, down, position));
    }
  }
  return grid;
}

RasterPosition moved_position(const GridOffsets& grid, const RasterPosition& position) {
  return {position.x + between(grid, grid.right, position), position.y + between(grid, grid.down, position)};
}

RasterPosition moved_back(const GridOffsets& grid, const RasterPosition& position) {
  // Newton's method with finite differences; the map is bilinear in each cell and close to the
  // identity.
  constexpr double step = 1e-6;
  const double longest = 0.5 / (grid.points - 1);
  RasterPosition back = position;
  for (int round = 0; round < 50; ++round) {
    const RasterPosition at = moved_position(grid, back);
    const double miss_x = position.x - at.x;
    const double miss_y = position.y - at.y;
    if (std::hypot(miss_x, miss_y) < 1e-12) {
      break;
    }
    const RasterPosition aside = moved_position(grid, {back.x + step, back.y});
    const RasterPosition below = moved_position(grid, {back.x, back.y + step});
    const double xx = (aside.x - at.x) / step;
    const double yx = (aside.y - at.y) / step;
    const double xy = (below.x - at.x) / step;
    const double yy = (below.y - at.y) / step;
    const double area = xx * yy - xy * yx;
    // Limits each step to half a cell. Far outside a cell, the continuation of its bilinear map may
    // fold.
    back.x += std::clamp((yy * miss_x - xy * miss_y) / area, -longest, longest);
    back.y += std::clamp((xx * miss_y - yx * miss_x) / area, -longest, longest);
  }
  return back;
}

WarpMesh moved_warp(const GridOffsets& grid, const WarpMesh& mesh) {
  WarpMesh shifted = refined_for(grid, mesh);
  for (WarpNode& node : shifted.nodes) {
    const RasterPosition position = moved_position(grid, RasterPosition{node.x, node.y});
    node.x = static_cast<float>(position.x);
    node.y = static_cast<float>(position.y);
  }
  return shifted;
}

WarpMesh refined_for(const GridOffsets& grid, const WarpMesh& mesh) {
  // Two cells of the mesh per cell of the grid follow its bilinear displacement well.
  constexpr int nodes_per_cell = 2;
  const int wanted = nodes_per_cell * (grid.points - 1);
  const auto parts_of = [&](int nodes) { return std::max((wanted + nodes - 2) / (nodes - 1), 1); };
  const int across = parts_of(mesh.columns);
  const int down = parts_of(mesh.rows);
  if (grid.points == 2 || mesh.topology != MeshTopology::rectangular || (across == 1 && down == 1)) {
    return mesh;
  }
  WarpMesh fine;
  fine.columns = (mesh.columns - 1) * across + 1;
  fine.rows = (mesh.rows - 1) * down + 1;
  fine.nodes.reserve(static_cast<std::size_t>(fine.columns) * static_cast<std::size_t>(fine.rows));
  for (int row = 0; row < fine.rows; ++row) {
    for (int column = 0; column < fine.columns; ++column) {
      fine.nodes.push_back(node_between(mesh, static_cast<double>(column) / across, static_cast<double>(row) / down));
    }
  }
  return fine;
}

BlendMap moved_mask(const GridOffsets& grid, const BlendMap& mask) {
  BlendMap shifted = mask;
  std::size_t value = 0;
  for (int row = 0; row < mask.height; ++row) {
    for (int column = 0; column < mask.width; ++column) {
      const RasterPosition from =
          moved_back(grid, {fill_position(column, mask.width), fill_position(row, mask.height)});
      for (int channel = 0; channel < mask.channels; ++channel) {
        shifted.values[value++] = read(mask, from, channel);
      }
    }
  }
  return shifted;
}

}  // namespace ergodome
