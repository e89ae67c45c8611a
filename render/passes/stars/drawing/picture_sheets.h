#pragma once

#include <vector>

#include "kernels/projection/cube_cells.h"

namespace ergodome {

//! A sheet: a part of a picture over which the projection is smooth and can be continued smoothly
//! beyond its edges. A sheet is the whole picture, or one face of a cube. Light that spreads across
//! the edge of a sheet is drawn on every sheet that it reaches.
struct PictureSheet {
  Projection projection;  //!< projection of the sheet as a separate picture
  PixelCell cell;         //!< position of the sheet in the picture
};

//! Returns the sheets of a picture: one, or one per cube face in the order of the faces.
std::vector<PictureSheet> picture_sheets(const Projection& projection);

}  // namespace ergodome
