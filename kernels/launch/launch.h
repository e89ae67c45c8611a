#pragma once

#include "kernels/launch/kernel_table.h"

namespace ergodome {

//! Where kernels run.
enum class Backend { cpu, cuda };

//! Why CUDA cannot be used here, or nothing (nullptr) when it can. Asked once; any error of the driver counts as "no GPU".
const char* cuda_unavailable_reason();

//! Traces a batch. With Backend::cuda the arrays are device memory and the call returns after the device has finished.
//!
//! The closed form is not a SIMD method: it runs one ray at a time.
void trace_rays(Backend backend, const RayBatch<float>& batch);
void trace_rays(Backend backend, const RayBatch<double>& batch);

//! Traces the pixels of an image; see PixelBatch.
void trace_pixels(Backend backend, const PixelBatch& batch);

//! Turns lens pixels into light or a heat map; see ShadeBatch.
void shade_pixels(Backend backend, const ShadeBatch& batch);

}  // namespace ergodome
