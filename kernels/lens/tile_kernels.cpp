#include "kernels/launch/register.h"
#include "kernels/lens/tile_shading_kernel.h"

namespace ergodome {

ERGO_CPU_KERNEL(TileLookUpBatch);
ERGO_CPU_KERNEL(TileShadeBatch);

}  // namespace ergodome
