#include "kernels/image/shade_pixels_kernel.h"
#include "kernels/launch/register.h"

namespace ergodome {

ERGO_KERNEL(ShadeBatch);

}  // namespace ergodome
