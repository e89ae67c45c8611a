#pragma once

#include "kernels/core/host_device.h"
#include "kernels/image/shade_pixels.h"

namespace ergodome::inline ERGO_TARGET {

//! The sky's light for pixels [begin, end), counted in registers of this instruction set; KernelTable::shade_sky. In a source of its own:
//! its variants are many.
void shade_sky(const ShadeBatch& batch, int begin, int end);

}  // namespace ergodome::inline ERGO_TARGET
