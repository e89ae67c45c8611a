#pragma once

#include "kernels/image/shade_pixels.h"
#include "kernels/trace/trace_pixels.h"
#include "kernels/trace/trace_rays.h"

namespace ergodome {

// The device side of kernels/launch/launch.h: launch_cuda.cu, and launch_without_cuda.cpp where there is no toolkit.

const char* find_cuda_unavailable_reason();
void trace_rays_cuda(const RayBatch<float>& batch);
void trace_rays_cuda(const RayBatch<double>& batch);
void trace_pixels_cuda(const PixelBatch& batch);
void shade_pixels_cuda(const ShadeBatch& batch);

}  // namespace ergodome
