#include "kernels/launch/register.h"
#include "kernels/lens/blend_check_kernel.h"
#include "kernels/lens/grid_build_kernel.h"
#include "kernels/lens/look_up_kernel.h"

namespace ergodome {

ERGO_KERNEL(NodeBatch<float>);
ERGO_CPU_KERNEL(NodeBatch<double>);
ERGO_KERNEL(CheckBatch<float>);
ERGO_CPU_KERNEL(CheckBatch<double>);
ERGO_CPU_KERNEL(BlendCheckBatch);
ERGO_KERNEL(LookUpRaysBatch<double>);

}  // namespace ergodome
