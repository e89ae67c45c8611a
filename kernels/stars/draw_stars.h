#pragma once

#include <cstdint>

#include "kernels/projection/cube_cells.h"
#include "kernels/projection/projection.h"
#include "kernels/stars/star_point.h"

namespace ergodome {

//! Side of the squares by which pixels find what shines on them [px].
inline constexpr int star_tile_px = 16;

//! Points of light to add to rows of a picture, each pixel for itself: so many threads as one likes make the same picture. Arrays lie in
//! the backend's memory.
struct StarLightBatch {
  float* rgba;                     //!< of the rows, four floats a pixel
  ProjectionOf<float> projection;  //!< of the whole picture
  int first_row;
  int end_row;
  PixelCell cells[cube_faces];  //!< where sheets lie in the picture
  const StarPoint* points;
  const std::int32_t* tiles;    //!< numbers of tiles that light may reach, row by row from the picture's top left
  const std::int32_t* first;    //!< of a tile's points in `members`, and where the last tile's end
  const std::int32_t* members;  //!< numbers of points, in the order in which their light is added
  int tile_columns;             //!< of the picture
  int count;                    //!< pixels of the tiles
  float narrower;               //!< 1 / (√2 σ) of the Gaussian; 0: light falls on the pixel that holds its point
  float reach_px;               //!< where the Gaussian ends
  float share;                  //!< half of one over the part of it that lies within
  const float*
      pattern;  //!< three floats a pixel: spikes of so many pixels across are added, and not the points; or nullptr
  int pattern_px;
};

}  // namespace ergodome
