#pragma once

#include "kernels/core/host_device.h"
#include "kernels/lens/look_up.h"

namespace ergodome::inline ERGO_TARGET {

//! Reads pixels from lens grids, for one eye or two, compiled once per instruction set. In a
//! separate source, so that other kernels do not affect how these are compiled.
void look_up_pixels(const LookUpBatch& batch, int begin, int end);
void look_up_pixel_pairs(const LookUpPairBatch& batch, int begin, int end);

}  // namespace ergodome::inline ERGO_TARGET
