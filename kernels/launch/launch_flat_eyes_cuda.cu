#include "kernels/flat_eyes/draw_flat_eyes_kernel.h"
#include "kernels/launch/launch_cuda.cuh"
#include "kernels/launch/launch_cuda.h"

namespace ergodome {

void draw_flat_eyes_cuda(const FlatEyeBatch& batch) {
  const PixelBatch& pixels = batch.near_field.pixels;
  launch_cuda("draw_flat_eyes", pixels.row_count * pixels.projection.width_px, DrawFlatEyes<float>{batch});
}

}  // namespace ergodome
