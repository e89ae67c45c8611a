#include "kernels/launch/own_objects.h"
#include "kernels/objects/look_at_flat_objects_kernel.h"
#include "kernels/objects/mark_flat_tiles_kernel.h"

// Compiled once per instruction set; ERGO_TARGET names it.
namespace ergodome::inline ERGO_TARGET {

void mark_flat_object_tiles(const FlatObjectTileBatch& batch, int begin, int end) {
  dispatch_flat_objects<MarkFlatTiles, WidePack<double>>(batch.tiles.objects.retarded, batch, [&](const auto& mark) {
    for (int index = begin; index < end; ++index) {
      mark(index);
    }
  });
}

void look_at_flat_objects(const FlatObjectPixelBatch& batch, int begin, int end) {
  dispatch_flat_objects<LookAtFlatObjects, WidePack<double>>(batch.pixels.objects.retarded, batch,
                                                             [&](const auto& look) {
                                                               for (int index = begin; index < end; ++index) {
                                                                 look(index);
                                                               }
                                                             });
}

}  // namespace ergodome::inline ERGO_TARGET
