#include "kernels/image/light_levels_kernel.h"
#include "kernels/image/warp_pixels_kernel.h"
#include "kernels/launch/register.h"

namespace ergodome {

ERGO_CPU_KERNEL(ToneBatch);
ERGO_CPU_KERNEL(AverageBatch);
ERGO_CPU_KERNEL(WarpBatch);

}  // namespace ergodome
