#include "kernels/image/shade_pixels_kernel.h"
#include "kernels/launch/launch_cuda.cuh"
#include "kernels/launch/launch_cuda.h"
#include "kernels/overlay/draw_overlay_kernel.h"

// All variants of shading, in a separate file because there are many.
namespace ergodome {

void shade_pixels_cuda(const ShadeBatch& batch) {
  if (batch.mode != ViewMode::sky) {
    return launch_cuda("shade_pixels", batch.count, ShadeHeatMap{batch});
  }
  // Adjacent pixels read the same texels.
  const int width = batch.projection.width_px;
  dispatch_shading<float>(
      batch, [&](const auto& functor) { launch_cuda_on_pixels("shade_pixels", width, batch.count / width, functor); });
}

namespace {

__global__ void count_negative_values(const float* values, long count, unsigned long long* sum) {
  const long at = static_cast<long>(blockIdx.x) * blockDim.x + threadIdx.x;
  const unsigned found = __ballot_sync(0xffffffffU, at < count && values[at] < 0.0F);
  if (threadIdx.x % 32 == 0 && found != 0U) {
    atomicAdd(sum, static_cast<unsigned long long>(__popc(found)));
  }
}

}  // namespace

long count_negative_cuda(const float* values, long count) {
  if (count <= 0) {
    return 0;
  }
  const DeviceScratch<unsigned long long> sum(1);
  check_cuda(cudaMemsetAsync(sum.data(), 0, sizeof(unsigned long long), current_stream()), "count_negative");
  constexpr int block = 256;
  const auto blocks = static_cast<unsigned>((count - 1) / block + 1);
  count_negative_values<<<blocks, block, 0, current_stream()>>>(values, count, sum.data());
  check_cuda(cudaGetLastError(), "count_negative");
  return static_cast<long>(read_cuda(sum.data(), "count_negative"));
}

void draw_overlay_cuda(const OverlayBatch& batch) {
  launch_cuda("draw_overlay", batch.count, DrawOverlay<float>{batch});
}

}  // namespace ergodome
