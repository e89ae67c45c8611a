#include "kernels/launch/register.h"
#include "kernels/published/quadtree_look_up_kernel.h"

namespace ergodome {

ERGO_KERNEL(QuadtreeRaysBatch);
ERGO_CPU_KERNEL(QuadtreePixelBatch);

}  // namespace ergodome
