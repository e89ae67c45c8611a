#include "kernels/launch/launch_cuda.h"
#include "kernels/launch/launch_in_steps_cuda.cuh"
#include "kernels/near_field/draw_near_field_kernel.h"

namespace ergodome {

void draw_near_field_cuda(const NearFieldBatch& batch) {
  const PixelBatch& pixels = batch.pixels;
  dispatch_near_field<DrawNearField, float>(batch, [&](const auto& draw) {
    launch_cuda_on_sampled_pixels("draw_near_field", pixels.projection.width_px, pixels.row_count, draw);
  });
}

}  // namespace ergodome
