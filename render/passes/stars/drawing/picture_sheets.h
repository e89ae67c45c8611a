#pragma once

#include <vector>

#include "kernels/projection/cube_cells.h"

namespace ergodome {

//! A part of a picture over which its projection is smooth, and goes on smoothly beside it: the whole of it, or one face of a cube. Light
//! that spreads over the end of a sheet is drawn on each that it reaches.
struct PictureSheet {
  Projection projection;  //!< of the sheet as a picture of its own
  PixelCell cell;         //!< where it lies in the picture
};

//! The sheets of a picture: one, or those of the faces in their order.
std::vector<PictureSheet> picture_sheets(const Projection& projection);

}  // namespace ergodome
