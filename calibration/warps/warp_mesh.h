#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "kernels/core/vector3.h"

// Where a projector's picture comes from: the one form in memory of every format of warps.
//
// Positions on the raster run from 0 to 1 across it, x to the right, y down, (0, 0) being the top left corner of the top left pixel.
// Texture coordinates run likewise across the source image: v = 0 is its top. Rows go from top to bottom, columns from left to right.
namespace ergodome {

//! Most columns or rows of a mesh, and most nodes: one for each pixel of an 8k UHD projector.
inline constexpr int most_mesh_side = 16'384;
inline constexpr std::size_t most_mesh_nodes = std::size_t{1} << 25U;

//! One node of a warp.
struct WarpNode {
  float x = 0.0F;  //!< on the raster; meshes may go beyond its rim
  float y = 0.0F;
  float u = 0.0F;  //!< in the source image
  float v = 0.0F;
  float intensity = 1.0F;  //!< factor of the source's values, >= 0
  bool valid = true;       //!< cells with a corner that is not are not drawn
};

//! How the cells of a mesh are connected.
enum class MeshTopology {
  rectangular,
  polar,           //!< columns go round: the first follows the last
  separate_cells,  //!< a cell for each triangle of a file, in no order on the raster, with undrawn nodes between
};

//! A warp in two dimensions: a grid of nodes, between which all is linear.
struct WarpMesh {
  MeshTopology topology = MeshTopology::rectangular;
  int columns = 0;
  int rows = 0;
  std::vector<WarpNode> nodes;  //!< rows * columns, row after row

  [[nodiscard]] WarpNode& at(int column, int row) { return nodes[index(column, row)]; }
  [[nodiscard]] const WarpNode& at(int column, int row) const { return nodes[index(column, row)]; }

 private:
  [[nodiscard]] std::size_t index(int column, int row) const {
    return static_cast<std::size_t>(row) * static_cast<std::size_t>(columns) + static_cast<std::size_t>(column);
  }
};

//! A warp in three dimensions: what point of the dome's surface each part of the raster meets.
//!
//! Samples fill the raster: sample (i, j) of n × m stands for position ((i + 1/2) / n, (j + 1/2) / m).
struct SurfaceMesh {
  int columns = 0;
  int rows = 0;
  std::vector<Vector3<float>> points;  //!< [m], x right, y up, z back as a viewer looks to the front; NaN where unknown
};

//! Throws Error, naming `place`, unless both sides are 2 to most_mesh_side and there are at most most_mesh_nodes nodes.
void check_mesh_size(long long columns, long long rows, const std::string& place);

//! A position's number of a row of `count` samples that fill the raster: sample `index` lies at (index + 1/2) / count (MPCDI's
//! "fill" layout, VESA MPCDI 2.0, 3.6).
inline double fill_position(int index, int count) { return (index + 0.5) / count; }

}  // namespace ergodome
