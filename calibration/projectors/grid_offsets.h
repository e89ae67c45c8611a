#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "calibration/projectors/projector_optics.h"
#include "calibration/warps/blend_map.h"
#include "calibration/warps/warp_mesh.h"

// Corrects a projector that was nudged: a grid of points moves its image back, with bilinear
// interpolation.
namespace ergodome {

//! Offsets of the points of a regular grid over the raster: to the right as fractions of its width,
//! downward as fractions of its height.
struct GridOffsets {
  //! Maximum offset of a point, as a fraction of the raster's width or height.
  static constexpr double farthest = 0.25;

  //! Maximum difference between the offsets of neighbors, as a fraction of their distance. Below
  //! 1/2, the displacement has an inverse.
  static constexpr double slack = 0.4;

  //! Possible numbers of points per side. Each grid contains the points of the smaller grids.
  static constexpr std::array sizes = {2, 3, 5, 9};

  int points = 2;  //!< points per side; 2: only the corners
  std::vector<double> right = std::vector<double>(4);
  std::vector<double> down = std::vector<double>(4);

  [[nodiscard]] bool none() const;

  //! Returns the index of a point, row by row.
  [[nodiscard]] std::size_t index(int column, int row) const {
    return static_cast<std::size_t>(row) * static_cast<std::size_t>(points) + static_cast<std::size_t>(column);
  }

  //! Sets the offset of a point, clamped to what `farthest` and `slack` allow.
  void move(std::size_t point, double new_right, double new_down);

  //! Returns the same displacement as a grid of another size. A coarser grid loses detail.
  [[nodiscard]] GridOffsets resized(int new_points) const;

  friend bool operator==(const GridOffsets&, const GridOffsets&) = default;
};

//! Returns the displaced position of a position on the raster. Positions outside the raster are
//! displaced like the nearest one on its edge.
RasterPosition moved_position(const GridOffsets& grid, const RasterPosition& position);

//! Inverts moved_position() to 1e-9, for positions on the raster.
RasterPosition moved_back(const GridOffsets& grid, const RasterPosition& position);

//! Returns a warp with moved nodes, after refining it with refined_for().
WarpMesh moved_warp(const GridOffsets& grid, const WarpMesh& mesh);

//! Returns a mesh with nodes added by interpolation, so that it has at least two cells per cell of
//! the grid. Returns it unchanged if it is not rectangular, or if the grid has only corners.
WarpMesh refined_for(const GridOffsets& grid, const WarpMesh& mesh);

//! Returns a mask that fits the moved warp: each pixel has the value of the position that is moved
//! there. Values at the mask's edge continue beyond it.
BlendMap moved_mask(const GridOffsets& grid, const BlendMap& mask);

}  // namespace ergodome
