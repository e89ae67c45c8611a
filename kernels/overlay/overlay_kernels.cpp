#include "kernels/launch/register.h"
#include "kernels/overlay/draw_overlay_kernel.h"

namespace ergodome {

ERGO_KERNEL(OverlayBatch);

}  // namespace ergodome
