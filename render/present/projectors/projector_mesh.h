#pragma once

#include <cstdint>
#include <vector>

#include "calibration/projectors/projector_picture.h"

// Triangles of a projector's warp.

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

}  // namespace ergodome
