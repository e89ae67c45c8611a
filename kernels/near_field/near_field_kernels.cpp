#include "kernels/launch/register.h"
#include "kernels/near_field/draw_near_field_kernel.h"
#include "kernels/near_field/look_up_disk_kernel.h"

namespace ergodome {

ERGO_CPU_KERNEL(NearFieldBatch);
ERGO_CPU_KERNEL(DiskLookUpBatch);

}  // namespace ergodome
