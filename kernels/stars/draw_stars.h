#pragma once

#include <cstdint>

#include "kernels/projection/cube_cells.h"
#include "kernels/projection/projection.h"
#include "kernels/stars/star_point.h"

namespace ergodome {

//! Side of the squares by which pixels find what shines on them [px].
inline constexpr int star_tile_px = 16;

//! Which points of light may shine on which squares. Arrays lie in the backend's memory.
struct StarTileBatch {
  const StarPoint* points;
  int point_count;
  int point_threads;  //!< that a point's tiles are shared by: those with spikes have many
  bool spikes_alone;  //!< points without spikes are left out
  double reach_px;    //!< how far light goes along x and along y
  int width_px;       //!< of the picture
  int height_px;
  bool wraps;   //!< it goes on round the sky
  int columns;  //!< of tiles
  int tile_count;
  std::int32_t* counts;  //!< of the tiles' points: zero before they are counted, and before they are listed
  //! Of a tile's points in `members`, and one more, where the last one's end.
  std::int32_t* first;
  std::int32_t* members;
};

//! What is done one after another: points are counted and, by what `first` has then, listed; what is listed is put into the points' order.
enum class StarTileStep { count, list, sort };

//! Points of light to add to rows of a picture, each pixel for itself: so many threads as one likes make the same picture. Arrays lie in
//! the backend's memory.
struct StarLightBatch {
  float* rgba;                     //!< of the rows, four floats a pixel
  ProjectionOf<float> projection;  //!< of the whole picture
  int first_row;
  int row_count;
  PixelCell cells[cube_faces];  //!< where sheets lie in the picture
  const StarPoint* points;
  const std::int32_t* first;  //!< see StarTileBatch
  const std::int32_t*
      members;  //!< numbers of points, in the order in which their light is added; the same twice counts once
  int tile_columns;
  float narrower;  //!< 1 / (√2 σ) of the Gaussian; 0: light falls on the pixel that holds its point
  float reach_px;  //!< where the Gaussian ends
  float share;     //!< half of one over the part of it that lies within
  const float*
      pattern;  //!< three floats a pixel: spikes of so many pixels across are added, and not the points; or nullptr
  int pattern_px;
};

}  // namespace ergodome
