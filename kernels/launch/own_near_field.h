#pragma once

#include "kernels/core/host_device.h"
#include "kernels/near_field/draw_near_field.h"

namespace ergodome::inline ERGO_TARGET {

//! Draws the near field over pixels [begin, end), compiled once per instruction set; see
//! NearFieldBatch. In a separate source, so that it does not affect how other kernels are compiled.
void draw_near_field(const NearFieldBatch& batch, int begin, int end);

}  // namespace ergodome::inline ERGO_TARGET
