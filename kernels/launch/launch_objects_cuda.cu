#include "kernels/launch/launch_cuda.cuh"
#include "kernels/launch/launch_cuda.h"
#include "kernels/mesh/look_at_objects_kernel.h"
#include "kernels/mesh/mark_tiles_kernel.h"

namespace ergodome {

void mark_object_tiles_cuda(const ObjectTileBatch& batch) {
  dispatch_objects<MarkTiles, double>(batch,
                                      [&](const auto& mark) { launch_cuda("mark_object_tiles", batch.count, mark); });
}

void look_at_objects_cuda(const ObjectPixelBatch& batch) {
  dispatch_objects<LookAtObjects, double>(batch,
                                          [&](const auto& look) { launch_cuda("look_at_objects", batch.count, look); });
}

void lay_objects_cuda(const LayObjectsBatch& batch) {
  launch_cuda("lay_objects", batch.row_count * batch.projection.width_px, LayObjects{batch});
}

}  // namespace ergodome
