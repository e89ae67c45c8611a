#include "kernels/launch/launch_cuda.cuh"
#include "kernels/launch/launch_cuda.h"
#include "kernels/objects/look_at_flat_objects_kernel.h"
#include "kernels/objects/mark_flat_tiles_kernel.h"
#include "kernels/objects/mark_tiles_kernel.h"

namespace ergodome {

void mark_object_tiles_cuda(const ObjectTileBatch& batch) {
  dispatch_objects<MarkTiles, double>(batch,
                                      [&](const auto& mark) { launch_cuda("mark_object_tiles", batch.count, mark); });
}

void look_at_objects_cuda(const ObjectPixelBatch& batch) {
  dispatch_objects<LookAtObjects, double>(batch,
                                          [&](const auto& look) { launch_cuda("look_at_objects", batch.count, look); });
}

void mark_flat_object_tiles_cuda(const FlatObjectTileBatch& batch) {
  dispatch_flat_objects<MarkFlatTiles, double>(batch.tiles.objects.retarded, batch, [&](const auto& mark) {
    launch_cuda("mark_flat_object_tiles", batch.tiles.count, mark);
  });
}

void look_at_flat_objects_cuda(const FlatObjectPixelBatch& batch) {
  dispatch_flat_objects<LookAtFlatObjects, double>(batch.pixels.objects.retarded, batch, [&](const auto& look) {
    launch_cuda("look_at_flat_objects", batch.pixels.count, look);
  });
}

void lay_objects_cuda(const LayObjectsBatch& batch) {
  launch_cuda("lay_objects", batch.row_count * batch.projection.width_px, LayObjects{batch});
}

}  // namespace ergodome
