#include "kernels/launch/register.h"
#include "kernels/spacetime/trace/trace_pixels_kernel.h"
#include "kernels/spacetime/trace/trace_rays_kernel.h"

namespace ergodome {

ERGO_KERNEL(RayBatch<float>);
ERGO_KERNEL(RayBatch<double>);
ERGO_KERNEL(PixelBatch);

}  // namespace ergodome
