#include "kernels/eyes/flat/look_at_flat_objects_kernel.h"
#include "kernels/eyes/flat/mark_flat_tiles_kernel.h"
#include "kernels/launch/register.h"

namespace ergodome {

ERGO_KERNEL(FlatObjectTileBatch);
ERGO_KERNEL(FlatObjectPixelBatch);

}  // namespace ergodome
