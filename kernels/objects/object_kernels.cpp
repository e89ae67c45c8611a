#include "kernels/launch/register.h"
#include "kernels/objects/look_at_objects_kernel.h"
#include "kernels/objects/mark_tiles_kernel.h"

namespace ergodome {

ERGO_KERNEL(ObjectTileBatch);
ERGO_KERNEL(ObjectPixelBatch);

}  // namespace ergodome
