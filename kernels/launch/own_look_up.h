#pragma once

#include "kernels/core/host_device.h"
#include "kernels/lens/look_up.h"

namespace ergodome::inline ERGO_TARGET {

//! Pixels that are read from lens grids, of one eye or of two. In a source of their own, so that nothing else changes how they are compiled.
void look_up_pixels(const LookUpBatch& batch, int begin, int end);
void look_up_pixel_pairs(const LookUpPairBatch& batch, int begin, int end);

}  // namespace ergodome::inline ERGO_TARGET
