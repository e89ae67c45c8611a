#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "calibration/blend_map.h"
#include "calibration/projector_optics.h"
#include "calibration/warp_mesh.h"

// A projector that was nudged: its picture is pulled back by a grid of points, bilinearly in between.
namespace ergodome {

//! How far each point of a regular grid over the raster is moved: parts of its width to the right, of its height downwards.
struct GridOffsets {
  //! Largest offset of a point.
  static constexpr double farthest = 0.25;

  //! Largest difference between the offsets of neighbors, as part of their distance: below 1/2 the displacement has an inverse.
  static constexpr double slack = 0.4;

  //! Grids that contain the points of all before them.
  static constexpr std::array sizes = {2, 3, 5, 9};

  int points = 2;  //!< on each side; 2 are the corners
  std::vector<double> right = std::vector<double>(4);
  std::vector<double> down = std::vector<double>(4);

  [[nodiscard]] bool none() const;

  //! Returns the number of a point, row by row.
  [[nodiscard]] std::size_t index(int column, int row) const {
    return static_cast<std::size_t>(row) * static_cast<std::size_t>(points) + static_cast<std::size_t>(column);
  }

  //! Moves a point as far as `farthest` and `slack` allow.
  void move(std::size_t point, double new_right, double new_down);

  //! The same displacement by a grid of another size. A coarser grid loses what it cannot hold.
  [[nodiscard]] GridOffsets resized(int new_points) const;

  friend bool operator==(const GridOffsets&, const GridOffsets&) = default;
};

//! Returns where a position of the raster is moved. Positions beyond its edge move as the nearest of the edge.
RasterPlace moved_place(const GridOffsets& grid, const RasterPlace& place);

//! Inverts moved_place() to 1e-9, for positions on the raster.
RasterPlace moved_back(const GridOffsets& grid, const RasterPlace& place);

//! Returns a warp with moved nodes; with more nodes than the mesh where the grid is finer.
WarpMesh moved_warp(const GridOffsets& grid, const WarpMesh& mesh);

//! Returns a mesh with nodes in between, close enough for the cells of a grid. It shows the same as before.
WarpMesh refined_for(const GridOffsets& grid, const WarpMesh& mesh);

//! Returns a mask that fits the moved warp: each pixel holds the value of the position that is moved there, beyond the edge that
//! of the edge.
BlendMap moved_mask(const GridOffsets& grid, const BlendMap& mask);

}  // namespace ergodome
