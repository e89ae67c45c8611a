#include "kernels/eyes/flat/draw_flat_eyes_kernel.h"
#include "kernels/near_rays/launch_sampled_pixels.cuh"

namespace ergodome {

template <>
void launch_on_cuda(const FlatEyeBatch& batch) {
  const PixelBatch& pixels = batch.near_field.pixels;
  dispatch<float>(batch, [&](const auto& draw) {
    launch_cuda_on_sampled_pixels("draw_flat_eyes", pixels.projection.width_px, pixels.row_count, draw);
  });
}

}  // namespace ergodome
