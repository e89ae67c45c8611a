#include "render/present/projectors/projector_mesh.h"

#include <array>

namespace ergodome {

namespace {

std::vector<MeshVertex> vertices_of(const WarpMesh& warp, const GridOffsets& grid) {
  std::vector<MeshVertex> vertices;
  vertices.reserve(warp.nodes.size() + 4);
  for (const auto& [x, y] : {std::array{0.0, 0.0}, std::array{1.0, 0.0}, std::array{1.0, 1.0}, std::array{0.0, 1.0}}) {
    const RasterPlace mask = moved_back(grid, {x, y});
    vertices.push_back({{static_cast<float>(x), static_cast<float>(y)},
                        {0.5F, 0.5F},
                        {static_cast<float>(mask.x), static_cast<float>(mask.y)},
                        0.0F});
  }
  for (const WarpNode& node : warp.nodes) {
    const RasterPlace place = moved_place(grid, RasterPlace{node.x, node.y});
    vertices.push_back({{static_cast<float>(place.x), static_cast<float>(place.y)},
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

}  // namespace ergodome
