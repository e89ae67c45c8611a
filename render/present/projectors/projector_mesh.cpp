#include "render/present/projectors/projector_mesh.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace ergodome {

namespace {

std::vector<MeshVertex> vertices_of(const WarpMesh& warp, const GridOffsets& grid) {
  std::vector<MeshVertex> vertices;
  vertices.reserve(warp.nodes.size() + 4);
  for (const auto& [x, y] : {std::array{0.0, 0.0}, std::array{1.0, 0.0}, std::array{1.0, 1.0}, std::array{0.0, 1.0}}) {
    const RasterPosition mask = moved_back(grid, {x, y});
    vertices.push_back({{static_cast<float>(x), static_cast<float>(y)},
                        {0.5F, 0.5F},
                        {static_cast<float>(mask.x), static_cast<float>(mask.y)},
                        0.0F});
  }
  for (const WarpNode& node : warp.nodes) {
    const RasterPosition position = moved_position(grid, RasterPosition{node.x, node.y});
    vertices.push_back({{static_cast<float>(position.x), static_cast<float>(position.y)},
                        {node.u, node.v},
                        {node.x, node.y},
                        node.intensity});
  }
  return vertices;
}

std::vector<std::uint32_t> indices_of(const WarpMesh& warp) {
  std::vector<std::uint32_t> indices = {0, 1, 2, 0, 2, 3};
  const int cells = warp.topology == MeshTopology::polar ? warp.columns : warp.columns - 1;
  for (int row = 0; row + 1 < warp.rows; ++row) {
    for (int column = 0; column < cells; ++column) {
      const int right = (column + 1) % warp.columns;
      if (!warp.at(column, row).valid || !warp.at(right, row).valid || !warp.at(right, row + 1).valid ||
          !warp.at(column, row + 1).valid) {
        continue;
      }
      const auto index = [&](int i, int j) { return static_cast<std::uint32_t>(4 + j * warp.columns + i); };
      indices.insert(indices.end(), {index(column, row), index(right, row), index(right, row + 1), index(column, row),
                                     index(right, row + 1), index(column, row + 1)});
    }
  }
  return indices;
}

}  // namespace

ProjectorMesh projector_mesh(const WarpMesh& warp, const GridOffsets& grid) {
  const WarpMesh fine = refined_for(grid, warp);
  return {vertices_of(fine, grid), indices_of(fine)};
}

namespace {

constexpr double steps_per_px = 256.0;
constexpr double farthest_rasters = 15.0;

//! An edge of a triangle; value() is positive inside the triangle.
struct Edge {
  double x;
  double y;
  double across;
  double down;

  [[nodiscard]] double value(double at_x, double at_y) const { return across * (at_y - y) - down * (at_x - x); }
  //! Returns whether a pixel with this value() is inside the edge. Pixels exactly on an edge belong
  //! to the triangle if it is an upper or left edge.
  [[nodiscard]] bool holds(double value) const {
    return value > 0.0 || (value == 0.0 && (down < 0.0 || (down == 0.0 && across > 0.0)));
  }
};

//! Interpolates linearly over a triangle from the values at its corners.
float between(float a, float b, float c, double at_b, double at_c) {
  return static_cast<float>(a + at_b * (static_cast<double>(b) - a) + at_c * (static_cast<double>(c) - a));
}

}  // namespace

MeshRaster::MeshRaster(ProjectorMesh mesh, int width_px, int height_px)
    : mesh_(std::move(mesh)),
      width_px_(width_px),
      height_px_(height_px),
      bands_(static_cast<std::size_t>((height_px + band_rows - 1) / band_rows)) {
  const auto triangles = static_cast<std::uint32_t>(mesh_.indices.size() / 3);
  for (std::uint32_t triangle = 0; triangle < triangles; ++triangle) {
    const std::uint32_t* const index = &mesh_.indices[3 * static_cast<std::size_t>(triangle)];
    const auto [top, bottom] = std::minmax({corner(index[0]).y, corner(index[1]).y, corner(index[2]).y});
    const int first = static_cast<int>(std::floor(top / (steps_per_px * band_rows)));
    const int last = static_cast<int>(std::floor(bottom / (steps_per_px * band_rows)));
    for (int band = std::max(first, 0); band <= std::min(last, band_count() - 1); ++band) {
      bands_[static_cast<std::size_t>(band)].push_back(triangle);
    }
  }
}

MeshRaster::Corner MeshRaster::corner(std::uint32_t vertex) const {
  const auto on_lattice = [](float position, int size) {
    const double within = std::clamp(static_cast<double>(position), -farthest_rasters, farthest_rasters);
    return std::round(steps_per_px * size * within);
  };
  const MeshVertex& at = mesh_.vertices[vertex];
  return {on_lattice(at.position[0], width_px_), on_lattice(at.position[1], height_px_)};
}

std::vector<MeshSample> MeshRaster::band(int band) const {
  const int first = band * band_rows;
  const int rows = std::min(band_rows, height_px_ - first);
  std::vector<MeshSample> samples(static_cast<std::size_t>(rows) * static_cast<std::size_t>(width_px_));
  for (const std::uint32_t triangle : bands_[static_cast<std::size_t>(band)]) {
    draw(triangle, first, rows, samples);
  }
  return samples;
}

void MeshRaster::draw(std::uint32_t triangle, int first_row, int rows, std::vector<MeshSample>& samples) const {
  std::uint32_t index[3];
  std::copy_n(&mesh_.indices[3 * static_cast<std::size_t>(triangle)], 3, index);
  Corner at[3] = {corner(index[0]), corner(index[1]), corner(index[2])};
  double area = (at[1].x - at[0].x) * (at[2].y - at[0].y) - (at[2].x - at[0].x) * (at[1].y - at[0].y);
  if (area == 0.0) {
    return;
  }
  if (area < 0.0) {
    std::swap(index[1], index[2]);
    std::swap(at[1], at[2]);
    area = -area;
  }
  const auto edge = [&](int from, int to) {
    return Edge{at[from].x, at[from].y, at[to].x - at[from].x, at[to].y - at[from].y};
  };
  const Edge ab = edge(0, 1);
  const Edge bc = edge(1, 2);
  const Edge ca = edge(2, 0);
  const MeshVertex& a = mesh_.vertices[index[0]];
  const MeshVertex& b = mesh_.vertices[index[1]];
  const MeshVertex& c = mesh_.vertices[index[2]];

  MeshSample sample;
  for (int i = 0; i < 2; ++i) {
    sample.along_x[i] = between(0.0F, b.source[i] - a.source[i], c.source[i] - a.source[i],
                                -ca.down * steps_per_px / area, -ab.down * steps_per_px / area);
    sample.along_y[i] = between(0.0F, b.source[i] - a.source[i], c.source[i] - a.source[i],
                                ca.across * steps_per_px / area, ab.across * steps_per_px / area);
  }
  const auto [left, right] = std::minmax({at[0].x, at[1].x, at[2].x});
  const auto [top, bottom] = std::minmax({at[0].y, at[1].y, at[2].y});
  const auto first_middle = [](double position) { return static_cast<int>(std::ceil(position / steps_per_px - 0.5)); };
  const auto last_middle = [](double position) { return static_cast<int>(std::floor(position / steps_per_px - 0.5)); };
  for (int row = std::max(first_middle(top), first_row); row <= std::min(last_middle(bottom), first_row + rows - 1);
       ++row) {
    const double y = steps_per_px * (row + 0.5);
    MeshSample* const to = &samples[static_cast<std::size_t>(row - first_row) * static_cast<std::size_t>(width_px_)];
    for (int column = std::max(first_middle(left), 0); column <= std::min(last_middle(right), width_px_ - 1);
         ++column) {
      const double x = steps_per_px * (column + 0.5);
      const double beside_ab = ab.value(x, y);
      const double beside_ca = ca.value(x, y);
      if (!ab.holds(beside_ab) || !ca.holds(beside_ca) || !bc.holds(bc.value(x, y))) {
        continue;
      }
      const double at_b = beside_ca / area;
      const double at_c = beside_ab / area;
      for (int i = 0; i < 2; ++i) {
        sample.source[i] = between(a.source[i], b.source[i], c.source[i], at_b, at_c);
        sample.mask[i] = between(a.mask[i], b.mask[i], c.mask[i], at_b, at_c);
      }
      sample.factor = between(a.factor, b.factor, c.factor, at_b, at_c);
      to[column] = sample;
    }
  }
}

}  // namespace ergodome
