#include "kernels/flat_eyes/draw_flat_eyes_kernel.h"
#include "kernels/launch/launch_cuda.cuh"
#include "kernels/launch/launch_cuda.h"

namespace ergodome {

void draw_flat_eyes_cuda(const FlatEyeBatch& batch) {
  const int count = batch.near_field.pixels.row_count * batch.near_field.pixels.projection.width_px;
  dispatch_flat_eyes<float>(batch, [&](const auto& draw) { launch_cuda("draw_flat_eyes", count, draw); });
}

}  // namespace ergodome
