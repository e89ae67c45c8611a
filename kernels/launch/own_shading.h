#pragma once

#include "kernels/core/host_device.h"
#include "kernels/image/shade_pixels.h"

namespace ergodome::inline ERGO_TARGET {

//! Computes the sky's light for registers [begin, end) of pixels, compiled once per instruction
//! set; see KernelTable::shade_sky. In a separate source because it has many variants.
void shade_sky(const ShadeBatch& batch, int begin, int end);

}  // namespace ergodome::inline ERGO_TARGET
