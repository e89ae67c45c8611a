#include "kernels/launch/register.h"
#include "kernels/lens/look_up_kernel.h"

namespace ergodome {

ERGO_CPU_KERNEL(LookUpBatch);
ERGO_CPU_KERNEL(LookUpPairBatch);

}  // namespace ergodome
