#pragma once

#include <cstdint>
#include <vector>

#include "calibration/projectors/projector_picture.h"

// Triangles of a projector's warp, and their values at pixels.

namespace ergodome {

//! A corner of the triangles that are drawn on a projector's raster.
struct MeshVertex {
  float position[2];  //!< position on the raster, 0 to 1, y down
  float source[2];    //!< position in the domemaster; 0 at its top
  float mask[2];      //!< position in the masks
  float factor;       //!< factor on the domemaster's light
};

//! Number of indices of the two triangles that cover the whole raster below all others. They show
//! no light of the domemaster.
inline constexpr int backdrop_indices = 6;

//! Triangles with linear interpolation. Where triangles overlap, the last one is visible.
struct ProjectorMesh {
  std::vector<MeshVertex> vertices;
  std::vector<std::uint32_t> indices;  //!< three per triangle
};

//! Builds the triangles: first the whole raster without light, so that parts outside the warp get
//! the black-level lift; then two triangles for each cell of the warp, refined by refined_for(),
//! divided along the same diagonal as in resampled_warp(), with nodes moved by the grid. Omits
//! cells with an invalid corner.
ProjectorMesh projector_mesh(const WarpMesh& warp, const GridOffsets& grid);

//! Values of a projector's mesh at the center of a pixel.
struct MeshSample {
  float source[2] = {};  //!< position in the domemaster, 0 to 1
  float mask[2] = {};    //!< position in the masks
  float factor = 0.0F;
  float along_x[2] = {};  //!< change of `source` from one pixel to the next to the right
  float along_y[2] = {};  //!< change of `source` from one pixel to the next below
};

//! Samples a mesh at the centers of a raster's pixels, as OpenGL does: corners lie on a lattice of
//! 1/256 pixel, and a pixel on an edge belongs to one triangle. Corners more than 15 raster sizes
//! away are moved to that distance.
class MeshRaster {
 public:
  //! Number of rows that are sampled at a time.
  static constexpr int band_rows = 32;

  MeshRaster(ProjectorMesh mesh, int width_px, int height_px);

  [[nodiscard]] int band_count() const { return static_cast<int>(bands_.size()); }

  //! Returns the samples of a band, row by row. Bands can be sampled in parallel.
  [[nodiscard]] std::vector<MeshSample> band(int band) const;

 private:
  struct Corner {
    double x;  //!< position on the raster [px / 256]
    double y;
  };
  [[nodiscard]] Corner corner(std::uint32_t vertex) const;
  void draw(std::uint32_t triangle, int first_row, int rows, std::vector<MeshSample>& samples) const;

  ProjectorMesh mesh_;
  int width_px_;
  int height_px_;
  //! For each band, the triangles that may touch it, in order.
  std::vector<std::vector<std::uint32_t>> bands_;
};

}  // namespace ergodome
