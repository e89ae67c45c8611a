#pragma once

#include "kernels/lens/look_up.h"

// Batches of pixels that are interpolated on tiles of the screen, between a few directions that are
// read from lens grids.
namespace ergodome {

//! Side of a tile [px]. Tiles that are not smooth enough are divided into quarters.
inline constexpr int tile_side = 16;

//! The pixels of a look-up, on tiles. Tiles start at the image's top left corner, wherever the block
//! of rows starts, so results do not depend on the blocks.
//!
//! In a tile, each component of the sky direction is a bicubic polynomial through the values at 4 x
//! 4 nodes (at the zeros of a Chebyshev polynomial). The nodes' derivatives, which the polynomial
//! does not use, give the error. Tiles whose error exceeds the tolerance, and those near the
//! shadow's edge or in leaves that are left to rays, are read pixel by pixel.
struct TileLookUpBatch {
  LookUpBatch look_up;
  float tolerance_px;  //!< maximum displacement on the screen that interpolation on tiles may add [px]
};

//! Returns the number of columns of tiles in an image.
constexpr int tile_columns(const TileLookUpBatch& batch) {
  return (batch.look_up.pixels.projection.width_px + tile_side - 1) / tile_side;
}

//! Returns the number of the first row of tiles that a block of rows touches, from the image's top.
constexpr int first_tile_row(const TileLookUpBatch& batch) { return batch.look_up.pixels.first_row / tile_side; }

//! Returns the number of rows of tiles that a block of rows touches.
constexpr int tile_rows(const TileLookUpBatch& batch) {
  const int end = batch.look_up.pixels.first_row + batch.look_up.pixels.row_count;
  return (end + tile_side - 1) / tile_side - first_tile_row(batch);
}

template <>
struct Kernel<TileLookUpBatch> : KernelDefaults {
  static constexpr bool one_element_a_call = true;
  static constexpr int grain = 4;
  static const char* name(const TileLookUpBatch& batch) {
    return has_footprints(batch.look_up.pixels.out) ? "look_up_tiles, footprints" : "look_up_tiles";
  }
  static int elements(const TileLookUpBatch& batch) { return tile_columns(batch) * tile_rows(batch); }
  static long work(const TileLookUpBatch& batch) { return element_count(batch.look_up); }

  template <class Visit>
  static void visit_outputs(const TileLookUpBatch& batch, const Visit& visit) {
    Kernel<LookUpBatch>::visit_outputs(batch.look_up, visit);
  }
};

}  // namespace ergodome
