#include "kernels/launch/register.h"
#include "kernels/lens/look_up_kernel.h"

namespace ergodome {

ERGO_CPU_KERNEL(LookUpBatch);

}  // namespace ergodome
