#include "kernels/disk/check_disk_grid_kernel.h"
#include "kernels/disk/disk_grid_kernel.h"
#include "kernels/launch/register.h"

namespace ergodome {

ERGO_CPU_KERNEL(DiskNodeBatch);
ERGO_CPU_KERNEL(DiskCheckBatch);
ERGO_CPU_KERNEL(DiskGridCheckBatch);

}  // namespace ergodome
