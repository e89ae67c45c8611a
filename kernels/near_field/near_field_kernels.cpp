#include "kernels/launch/register.h"
#include "kernels/near_field/draw_near_field_kernel.h"

namespace ergodome {

ERGO_CPU_KERNEL(NearFieldBatch);

}  // namespace ergodome
