#include "kernels/launch/own_objects.h"

#include "kernels/objects/look_at_objects_kernel.h"
#include "kernels/objects/mark_tiles_kernel.h"

// Compiled once per instruction set; ERGO_TARGET names it.
namespace ergodome::inline ERGO_TARGET {

void mark_object_tiles(const ObjectTileBatch& batch, int begin, int end) {
  dispatch_objects<MarkTiles, WidePack<double>>(batch, [&](const auto& mark) {
    for (int index = begin; index < end; ++index) {
      mark(index);
    }
  });
}

void look_at_objects(const ObjectPixelBatch& batch, int begin, int end) {
  dispatch_objects<LookAtObjects, WidePack<double>>(batch, [&](const auto& look) {
    for (int index = begin; index < end; ++index) {
      look(index);
    }
  });
}

}  // namespace ergodome::inline ERGO_TARGET
