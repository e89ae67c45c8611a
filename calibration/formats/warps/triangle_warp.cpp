#include "calibration/formats/warps/triangle_warp.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "kernels/core/error.h"

namespace ergodome {

namespace {

//! A triangle as a part of a grid cell. The bits of `corners` state which corners of the cell it
//! has: bits 0 and 1 those in the first row, bits 2 and 3 those in the second.
struct CellPart {
  std::size_t cell;  //!< index of the cell's first node
  unsigned corners;
};

std::optional<CellPart> part_of_cell(const WarpTriangle& triangle, std::size_t columns) {
  const std::size_t first = *std::ranges::min_element(triangle);
  // The triangle's smallest node index is that of the cell's first node, or of its second if the
  // triangle does not have the first.
  for (const std::size_t back : {std::size_t{0}, std::size_t{1}}) {
    if (first < back || (first - back) % columns + 1 == columns) {
      continue;
    }
    const std::size_t cell = first - back;
    unsigned corners = 0;
    for (const std::uint32_t node : triangle) {
      const std::size_t ahead = node - cell;
      corners |= ahead <= 1 ? 1U << ahead : 0U;
      corners |= ahead == columns || ahead == columns + 1 ? 4U << (ahead - columns) : 0U;
    }
    if (corners == 7U || corners == 11U || corners == 13U || corners == 14U) {
      return CellPart{cell, corners};
    }
  }
  return std::nullopt;
}

//! Returns true if two triangles, given by their corner bits, together fill a cell: they share a
//! diagonal.
bool fills_cell(unsigned a, unsigned b) { return (a | b) == 15U && ((a & b) == 9U || (a & b) == 6U); }

//! Returns true if the triangles are the two halves of every cell of a grid with `columns` columns
//! of nodes.
bool is_grid(std::size_t nodes, const std::vector<WarpTriangle>& triangles, std::size_t columns) {
  if (columns < 2 || nodes % columns != 0 || nodes / columns < 2 ||
      triangles.size() != 2 * (columns - 1) * (nodes / columns - 1)) {
    return false;
  }
  std::vector<unsigned char> found(nodes, 0);
  std::size_t filled = 0;
  for (const WarpTriangle& triangle : triangles) {
    const auto part = part_of_cell(triangle, columns);
    if (!part) {
      return false;
    }
    unsigned char& seen = found[part->cell];
    if (seen != 0 && !fills_cell(seen, part->corners)) {
      return false;
    }
    filled += seen != 0 ? 1 : 0;
    seen = static_cast<unsigned char>(seen | part->corners);
  }
  return 2 * filled == triangles.size();
}

//! Returns the number of columns of nodes in the grid that the triangles form; 0 if they do not
//! form one.
std::size_t grid_columns(std::size_t nodes, const std::vector<WarpTriangle>& triangles) {
  std::size_t widest = 0;
  for (const WarpTriangle& triangle : triangles) {
    const auto [minimum, maximum] = std::ranges::minmax(triangle);
    widest = std::max<std::size_t>(widest, maximum - minimum);
  }
  for (const std::size_t columns : {widest, widest - std::min<std::size_t>(widest, 1)}) {
    if (is_grid(nodes, triangles, columns)) {
      return columns;
    }
  }
  return 0;
}

//! Returns a mesh with a cell for each triangle, and undrawn nodes between the cells.
WarpMesh separate_cells(const std::vector<WarpNode>& nodes, const std::vector<WarpTriangle>& triangles,
                        const std::string& file) {
  constexpr std::size_t max_in_row = (max_mesh_side + 1) / 3;
  const std::size_t across = std::min(triangles.size(), max_in_row);
  const std::size_t down = (triangles.size() + across - 1) / across;
  WarpMesh mesh;
  check_mesh_size(static_cast<long long>(3 * across - 1), static_cast<long long>(3 * down - 1), file);
  mesh.topology = MeshTopology::separate_cells;
  mesh.columns = static_cast<int>(3 * across - 1);
  mesh.rows = static_cast<int>(3 * down - 1);
  WarpNode gap;
  gap.valid = false;
  mesh.nodes.resize(static_cast<std::size_t>(mesh.columns) * static_cast<std::size_t>(mesh.rows), gap);
  for (std::size_t i = 0; i < triangles.size(); ++i) {
    const int column = static_cast<int>(3 * (i % across));
    const int row = static_cast<int>(3 * (i / across));
    const auto& [a, b, c] = triangles[i];
    mesh.at(column, row) = nodes[a];
    mesh.at(column + 1, row) = nodes[b];
    mesh.at(column + 1, row + 1) = nodes[c];
    mesh.at(column, row + 1) = nodes[c];
  }
  return mesh;
}

//! Signed difference of the position on the raster from the first column to the last, summed over
//! all rows in which both end nodes are drawn.
struct Extent {
  double x = 0.0;
  double y = 0.0;
};

Extent along_columns(const WarpMesh& mesh) {
  Extent sum;
  for (int row = 0; row < mesh.rows; ++row) {
    const WarpNode& first = mesh.at(0, row);
    const WarpNode& last = mesh.at(mesh.columns - 1, row);
    sum.x += first.valid && last.valid ? static_cast<double>(last.x) - first.x : 0.0;
    sum.y += first.valid && last.valid ? static_cast<double>(last.y) - first.y : 0.0;
  }
  return sum;
}

WarpMesh transposed(const WarpMesh& mesh) {
  WarpMesh turned{mesh.topology, mesh.rows, mesh.columns, std::vector<WarpNode>(mesh.nodes.size())};
  for (int row = 0; row < mesh.rows; ++row) {
    for (int column = 0; column < mesh.columns; ++column) {
      turned.at(row, column) = mesh.at(column, row);
    }
  }
  return turned;
}

void mirror_columns(WarpMesh& mesh) {
  for (int row = 0; row < mesh.rows; ++row) {
    std::reverse(&mesh.at(0, row), &mesh.at(0, row) + mesh.columns);
  }
}

}  // namespace

WarpMesh in_reading_order(WarpMesh mesh) {
  Extent along = along_columns(mesh);
  if (std::abs(along.y) > std::abs(along.x)) {
    mesh = transposed(mesh);
    along = along_columns(mesh);
  }
  if (along.x < 0.0) {
    mirror_columns(mesh);
  }
  WarpMesh turned = transposed(mesh);
  if (along_columns(turned).y < 0.0) {
    mirror_columns(turned);
    mesh = transposed(turned);
  }
  return mesh;
}

WarpMesh warp_from_triangles(std::vector<WarpNode> nodes, const std::vector<WarpTriangle>& triangles,
                             const std::string& file) {
  for (const WarpTriangle& triangle : triangles) {
    if (const std::uint32_t maximum = *std::ranges::max_element(triangle); maximum >= nodes.size()) {
      throw Error(file,
                  fmt::format("has a triangle with node {}, but only {} nodes, counted from 0", maximum, nodes.size()),
                  "the file is truncated or damaged; export it again");
    }
  }
  if (triangles.empty()) {
    throw Error(file, "contains no triangles", "export it again");
  }
  const std::size_t columns = grid_columns(nodes.size(), triangles);
  const std::size_t rows = columns == 0 ? 0 : nodes.size() / columns;
  if (columns == 0 || columns > max_mesh_side || rows > max_mesh_side) {
    return separate_cells(nodes, triangles, file);
  }
  return in_reading_order(
      {MeshTopology::rectangular, static_cast<int>(columns), static_cast<int>(rows), std::move(nodes)});
}

std::vector<WarpTriangle> triangles_of_strip(const std::vector<std::uint32_t>& indices) {
  std::vector<WarpTriangle> triangles;
  for (std::size_t i = 0; i + 2 < indices.size(); ++i) {
    const WarpTriangle triangle = {indices[i], indices[i + 1], indices[i + 2]};
    if (triangle[0] != triangle[1] && triangle[1] != triangle[2] && triangle[0] != triangle[2]) {
      triangles.push_back(triangle);
    }
  }
  return triangles;
}

}  // namespace ergodome
