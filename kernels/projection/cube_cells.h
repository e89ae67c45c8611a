#pragma once

#include "kernels/projection/make_projection.h"

// Faces of a picture of a whole cube.
namespace ergodome {

//! A rectangle of pixels.
struct PixelCell {
  int left_px;
  int top_px;
  int width_px;
  int height_px;
};

inline namespace ERGO_TARGET {

//! Returns the rectangle of a face in the picture of a whole cube.
ERGO_HD PixelCell cube_face_cell(const Projection& projection, CubeFace face) {
  const CubeLayout layout = projection.cube.layout;
  const int columns = cube_columns(layout);
  const int side_px = projection.width_px / columns;
  const CubeCell cell = cube_cell(layout, face);
  const int column = projection.left < 0.0 ? cell.column : columns - 1 - cell.column;
  return {column * side_px, cell.row * side_px, side_px, side_px};
}

//! Returns a projection of one face of the picture of a whole cube.
ERGO_HD Projection cube_face_of(const Projection& projection, CubeFace face) {
  Projection alone = make_cube_face_projection(projection.width_px / cube_columns(projection.cube.layout), face);
  alone.left = projection.left;
  return alone;
}

}  // namespace ERGO_TARGET
}  // namespace ergodome
