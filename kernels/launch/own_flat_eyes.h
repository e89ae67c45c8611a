#pragma once

#include "kernels/core/host_device.h"
#include "kernels/eyes/flat/draw_flat_eyes.h"

namespace ergodome::inline ERGO_TARGET {

//! Draws the near field as an eye of the stereo model `flat` sees it, compiled once per instruction
//! set. In a separate source, so that it does not affect how other kernels are compiled.
void draw_flat_eyes(const FlatEyeBatch& batch, int begin, int end);
void look_up_flat_eyes(const FlatEyeLookUpBatch& batch, int begin, int end);

}  // namespace ergodome::inline ERGO_TARGET
