#include "render/picture/picture_rows.h"

namespace ergodome {

namespace {

//! Pixels per block on a GPU, which needs many to be busy. On the CPU blocks are small, so that the
//! lens channels (6 MiB) stay in the cache until they are shaded.
constexpr int block_pixels_on_device = 1 << 20;
constexpr int block_pixels_on_host = 1 << 17;
//! Pixels of each eye that are rendered at a time if the skies of two eyes alternate: a quarter of
//! a CPU block, because the channels of both eyes share the cache.
constexpr int strip_pixels = 1 << 15;

}  // namespace

int rows_of_a_block(Backend backend, int width_px, int height_px) {
  const int pixels = backend == Backend::cpu ? block_pixels_on_host : block_pixels_on_device;
  return std::clamp(pixels / width_px, 1, height_px);
}

int rows_of_a_strip(int width_px) { return std::max(strip_pixels / width_px, 1); }

}  // namespace ergodome
