#include "kernels/launch/register.h"
#include "kernels/near_rays/follow_rays_kernel.h"

namespace ergodome {

ERGO_CPU_KERNEL(FollowBatch);

}  // namespace ergodome
