#pragma once

#include <cstdint>
#include <vector>

#include "calibration/projectors/projector_picture.h"

namespace ergodome {

//! A corner of the triangles that a projector's raster is made of.
struct MeshVertex {
  float place[2];   //!< on the raster, 0 to 1, y down
  float source[2];  //!< in the master, its top at 0
  float mask[2];    //!< in the masks
  float factor;     //!< of the master's light
};

//! Indices of the two triangles that cover the raster below all others, without light of the master.
inline constexpr int backdrop_indices = 6;

//! Triangles between which all is linear; where they overlap the last one counts.
struct ProjectorMesh {
  std::vector<MeshVertex> vertices;
  std::vector<std::uint32_t> indices;  //!< three a triangle
};

//! The whole raster without light, so that it is lifted where the warp is not drawn; then the warp's cells, moved by the grid, as two triangles
//! each, cut as resampled_warp cuts them. Cells with a corner that is not valid are left out.
ProjectorMesh projector_mesh(const WarpMesh& warp, const GridOffsets& grid);

}  // namespace ergodome
