#pragma once

#include "kernels/core/host_device.h"
#include "kernels/near_field/draw_near_field.h"

namespace ergodome::inline ERGO_TARGET {

//! Draws what stands near the hole over pixels [begin, end); see NearFieldBatch. In a source of its own, so that it changes nothing in how other
//! kernels are compiled.
void draw_near_field(const NearFieldBatch& batch, int begin, int end);

}  // namespace ergodome::inline ERGO_TARGET
