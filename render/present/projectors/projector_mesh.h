#pragma once

#include <cstdint>
#include <vector>

#include "calibration/projectors/projector_picture.h"

// Triangles of a projector's warp, and their values at pixels.

namespace ergodome {

//! A corner of the triangles in a projector's raster.
struct MeshVertex {
  float place[2];   //!< on the raster, 0 to 1, y down
  float source[2];  //!< in the master, its top at 0
  float mask[2];    //!< in the masks
  float factor;     //!< on the master's light
};

//! Indices of the two triangles that cover the whole raster below the others, without light from
//! the master.
inline constexpr int backdrop_indices = 6;

//! Triangles with linear interpolation; where they overlap the last one is drawn.
struct ProjectorMesh {
  std::vector<MeshVertex> vertices;
  std::vector<std::uint32_t> indices;  //!< three per triangle
};

//! Builds the mesh: first the whole raster without light, so that parts outside the warp are
//! lifted, then the warp's cells, moved by the grid, as two triangles each, cut like those of
//! resampled_warp. Omits cells with an invalid corner.
ProjectorMesh projector_mesh(const WarpMesh& warp, const GridOffsets& grid);

//! Values of a projector's mesh at the center of a pixel.
struct MeshSample {
  float source[2] = {};  //!< in the master, 0 to 1
  float mask[2] = {};    //!< in the masks
  float factor = 0.0F;
  float along_x[2] = {};  //!< change of `source` from pixel to pixel along a row
  float along_y[2] = {};  //!< change of `source` down a column
};

//! Samples a mesh at the centers of a raster's pixels, as OpenGL does: corners lie on a lattice of
//! 1/256 pixel, and a pixel on an edge belongs to one triangle. Corners more than 15 raster sizes
//! away are moved to that distance.
class MeshRaster {
 public:
  //! Rows that are sampled at a time.
  static constexpr int band_rows = 32;

  MeshRaster(ProjectorMesh mesh, int width_px, int height_px);

  [[nodiscard]] int band_count() const { return static_cast<int>(bands_.size()); }

  //! Returns the samples of a band, row by row. Bands can be sampled in parallel.
  [[nodiscard]] std::vector<MeshSample> band(int band) const;

 private:
  struct Corner {
    double x;  //!< [px / 256]
    double y;
  };
  [[nodiscard]] Corner corner(std::uint32_t vertex) const;
  void draw(std::uint32_t triangle, int first_row, int rows, std::vector<MeshSample>& samples) const;

  ProjectorMesh mesh_;
  int width_px_;
  int height_px_;
  std::vector<std::vector<std::uint32_t>> bands_;  //!< triangles that may touch each band, in order
};

}  // namespace ergodome
