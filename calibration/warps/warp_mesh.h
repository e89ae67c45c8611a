#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "kernels/core/vector3.h"

// Mapping from a projector's raster to its source image: the common in-memory form of all warp
// formats.
//
// Positions on the raster run from 0 to 1 across it, x to the right, y down; (0, 0) is the top left
// corner of the top left pixel. Texture coordinates run likewise across the source image: v = 0 is
// its top. Rows go from top to bottom, columns from left to right.
namespace ergodome {

//! Maximum number of columns or rows of a mesh, and of its nodes: one for each pixel of an 8K UHD
//! projector.
inline constexpr int max_mesh_side = 16'384;
inline constexpr std::size_t max_mesh_nodes = std::size_t{1} << 25U;

//! One node of a warp.
struct WarpNode {
  float x = 0.0F;  //!< position on the projector's raster; may be outside it
  float y = 0.0F;
  float u = 0.0F;  //!< position in the source image
  float v = 0.0F;
  float intensity = 1.0F;  //!< factor of the source's values, >= 0
  bool valid = true;       //!< cells with an invalid corner are not drawn
};

//! How the cells of a mesh are connected.
enum class MeshTopology {
  rectangular,
  polar,           //!< columns go around: the first follows the last
  separate_cells,  //!< a cell for each triangle of a file, in any order on the raster, with undrawn nodes between
};

//! A two-dimensional warp: a grid of nodes with linear interpolation between them.
struct WarpMesh {
  MeshTopology topology = MeshTopology::rectangular;
  int columns = 0;
  int rows = 0;
  std::vector<WarpNode> nodes;  //!< rows * columns, row by row

  [[nodiscard]] WarpNode& at(int column, int row) { return nodes[index(column, row)]; }
  [[nodiscard]] const WarpNode& at(int column, int row) const { return nodes[index(column, row)]; }

 private:
  [[nodiscard]] std::size_t index(int column, int row) const {
    return static_cast<std::size_t>(row) * static_cast<std::size_t>(columns) + static_cast<std::size_t>(column);
  }
};

//! A three-dimensional warp: the point of the dome's surface that each part of the raster lights.
//!
//! Samples fill the raster: sample (i, j) of n × m is at position ((i + 1/2) / n, (j + 1/2) / m).
struct SurfaceMesh {
  int columns = 0;
  int rows = 0;
  //! [m] from the dome's center: x right, y up, z back, facing the front; NaN if unknown.
  std::vector<Vector3<float>> points;
};

//! Throws Error, which names `location`, unless both sides are 2 to max_mesh_side and there are at
//! most max_mesh_nodes nodes.
void check_mesh_size(long long columns, long long rows, const std::string& location);

//! Returns the position of sample `index` in a row of `count` samples that fill the raster: (index
//! + 1/2) / count (MPCDI's "fill" layout, VESA MPCDI 2.0, 3.6).
inline double fill_position(int index, int count) { return (index + 0.5) / count; }

}  // namespace ergodome
