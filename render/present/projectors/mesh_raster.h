#pragma once

#include <vector>

#include "render/present/projectors/projector_mesh.h"

// Samples a projector's mesh at each pixel, on the CPU.

namespace ergodome {

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
