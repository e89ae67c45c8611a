#pragma once

#include <vector>

#include "kernels/projection/cube_cells.h"

namespace ergodome {

//! A region: a part of a picture over which the projection is smooth and can be continued smoothly
//! beyond its edges. A region is the whole picture, or one face of a cube. Light that spreads
//! across the edge of a region is drawn on every region that it reaches.
struct PictureRegion {
  Projection projection;  //!< projection of the region as a separate picture
  PixelCell cell;         //!< position of the region in the picture
};

//! Returns the regions of a picture: one, or one per cube face in the order of the faces.
std::vector<PictureRegion> picture_regions(const Projection& projection);

}  // namespace ergodome
