#pragma once

#include "kernels/core/host_device.h"
#include "kernels/eyes/flat/draw_flat_eyes.h"

namespace ergodome::inline ERGO_TARGET {

//! Draws what stands near the hole as an eye of the stereo model `flat` sees it. In a source of its own, so that it changes nothing in how other
//! kernels are compiled.
void draw_flat_eyes(const FlatEyeBatch& batch, int begin, int end);
void look_up_flat_eyes(const FlatEyeLookUpBatch& batch, int begin, int end);

}  // namespace ergodome::inline ERGO_TARGET
