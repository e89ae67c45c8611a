#include "kernels/launch/register.h"
#include "kernels/spacetime/shadow/edge_kernel.h"

namespace ergodome {

ERGO_KERNEL(EdgeBatch);

}  // namespace ergodome
