#pragma once

#include "kernels/core/host_device.h"
#include "kernels/image/warp_pixels.h"

namespace ergodome::inline ERGO_TARGET {

//! Light of tiles [begin, end), averages of tiles, groups of projectors' pixels; see the batches. In a source of its own, so that it changes
//! nothing in how other kernels are compiled.
void tone_tiles(const ToneBatch& batch, int begin, int end);
void average_tiles(const AverageBatch& batch, int begin, int end);
void warp_pixels(const WarpBatch& batch, int begin, int end);

}  // namespace ergodome::inline ERGO_TARGET
