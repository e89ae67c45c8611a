#pragma once

#include "kernels/core/host_device.h"
#include "kernels/image/warp_pixels.h"

namespace ergodome::inline ERGO_TARGET {

//! Computes light and averages of tiles [begin, end), and groups of projectors' pixels, compiled
//! once per instruction set; see the batches. In a separate source, so that they do not affect how
//! other kernels are compiled.
void tone_tiles(const ToneBatch& batch, int begin, int end);
void average_tiles(const AverageBatch& batch, int begin, int end);
void warp_pixels(const WarpBatch& batch, int begin, int end);

}  // namespace ergodome::inline ERGO_TARGET
