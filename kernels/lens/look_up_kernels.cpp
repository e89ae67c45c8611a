#include "kernels/launch/register.h"
#include "kernels/lens/look_up_kernel.h"
#include "kernels/lens/tile_look_up_kernel.h"

namespace ergodome {

ERGO_CPU_KERNEL(LookUpBatch);
ERGO_CPU_KERNEL(LookUpPairBatch);
ERGO_CPU_KERNEL(TileLookUpBatch);

}  // namespace ergodome
