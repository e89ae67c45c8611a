#include "kernels/launch/launch_cuda.cuh"
#include "kernels/launch/launch_cuda.h"
#include "kernels/near_field/draw_near_field_kernel.h"

namespace ergodome {

void draw_near_field_cuda(const NearFieldBatch& batch) {
  const int count = batch.pixels.row_count * batch.pixels.projection.width_px;
  dispatch_near_field<DrawNearField, float>(batch,
                                            [&](const auto& draw) { launch_cuda("draw_near_field", count, draw); });
}

}  // namespace ergodome
