#include "kernels/eyes/flat/draw_flat_eyes_kernel.h"
#include "kernels/launch/launch_cuda.h"
#include "kernels/launch/launch_in_steps_cuda.cuh"

namespace ergodome {

void draw_flat_eyes_cuda(const FlatEyeBatch& batch) {
  const PixelBatch& pixels = batch.near_field.pixels;
  dispatch_flat_eyes<float>(batch, [&](const auto& draw) {
    launch_cuda_on_sampled_pixels("draw_flat_eyes", pixels.projection.width_px, pixels.row_count, draw);
  });
}

}  // namespace ergodome
