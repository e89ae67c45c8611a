#include "kernels/near_field/draw_near_field_kernel.h"
#include "kernels/near_rays/launch_sampled_pixels.cuh"

namespace ergodome {

template <>
void launch_on_cuda(const NearFieldBatch& batch) {
  const PixelBatch& pixels = batch.pixels;
  dispatch<float>(batch, [&](const auto& draw) {
    launch_cuda_on_sampled_pixels("draw_near_field", pixels.projection.width_px, pixels.row_count, draw);
  });
}

}  // namespace ergodome
