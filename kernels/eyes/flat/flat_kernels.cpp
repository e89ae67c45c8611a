#include "kernels/eyes/flat/affine_distances_kernel.h"
#include "kernels/eyes/flat/draw_flat_eyes_kernel.h"
#include "kernels/eyes/flat/look_up_flat_eyes_kernel.h"
#include "kernels/launch/register.h"

namespace ergodome {

ERGO_CPU_KERNEL(AffineDistanceBatch);
ERGO_CPU_KERNEL(FlatEyeBatch);
ERGO_CPU_KERNEL(FlatEyeLookUpBatch);

}  // namespace ergodome
