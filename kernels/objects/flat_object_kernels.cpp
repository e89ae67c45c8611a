#include "kernels/launch/register.h"
#include "kernels/objects/look_at_flat_objects_kernel.h"
#include "kernels/objects/mark_flat_tiles_kernel.h"

namespace ergodome {

ERGO_KERNEL(FlatObjectTileBatch);
ERGO_KERNEL(FlatObjectPixelBatch);

}  // namespace ergodome
