#include "kernels/disk/draw_disk_kernel.h"
#include "kernels/launch/launch_cuda.cuh"
#include "kernels/launch/launch_cuda.h"

namespace ergodome {

void draw_disk_cuda(const DiskBatch& batch) {
  const int count = batch.pixels.row_count * batch.pixels.projection.width_px;
  if (has_pattern(batch.look)) {
    launch_cuda("draw_disk", count, DrawDisk<float, true>{batch});
  } else {
    launch_cuda("draw_disk", count, DrawDisk<float, false>{batch});
  }
}

}  // namespace ergodome
