#include "render/picture/picture_rows.h"

#include <algorithm>

#include "kernels/lens/tile_look_up.h"

namespace ergodome {

namespace {

//! Pixels per block on a GPU, which needs many to be busy. On the CPU blocks are small, so that the
//! lens channels (6 MiB) stay in the cache until they are shaded.
constexpr int block_pixels_on_device = 1 << 20;
constexpr int block_pixels_on_host = 1 << 17;
//! Pixels of each eye that are rendered at a time if the skies of two eyes alternate: a quarter of
//! a CPU block, because the channels of both eyes share the cache.
constexpr int strip_pixels = 1 << 15;

//! Returns the rows of about `pixels` pixels: whole tiles, because a tile that is divided between two
//! blocks is computed for both.
int rows_of_tiles(int pixels, int width_px) { return std::max(pixels / width_px / tile_side, 1) * tile_side; }

}  // namespace

int rows_of_a_block(Backend backend, int width_px, int height_px) {
  const int rows = backend == Backend::cpu ? rows_of_tiles(block_pixels_on_host, width_px)
                                           : std::max(block_pixels_on_device / width_px, 1);
  return std::min(rows, height_px);
}

int rows_of_a_strip(int width_px) { return rows_of_tiles(strip_pixels, width_px); }

}  // namespace ergodome
