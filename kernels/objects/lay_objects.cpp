#include "kernels/objects/lay_objects.h"

#include "kernels/launch/register.h"

namespace ergodome {

ERGO_KERNEL(LayObjectsBatch);

}  // namespace ergodome
