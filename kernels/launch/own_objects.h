#pragma once

#include "kernels/core/host_device.h"
#include "kernels/objects/draw_objects.h"

// Kernels for objects, compiled once per instruction set.
namespace ergodome::inline ERGO_TARGET {

void mark_object_tiles(const ObjectTileBatch& batch, int begin, int end);
void look_at_objects(const ObjectPixelBatch& batch, int begin, int end);
void mark_flat_object_tiles(const FlatObjectTileBatch& batch, int begin, int end);
void look_at_flat_objects(const FlatObjectPixelBatch& batch, int begin, int end);

}  // namespace ergodome::inline ERGO_TARGET
