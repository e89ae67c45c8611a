#include "kernels/eyes/omni/omni_batches.h"
#include "kernels/launch/register.h"
#include "kernels/lens/grid_build_kernel.h"
#include "kernels/lens/look_up_kernel.h"
#include "kernels/spacetime/trace/trace_pixels_kernel.h"
#include "kernels/spacetime/trace/trace_rays_kernel.h"
#include "kernels/stars/star_images_kernel.h"

namespace ergodome {

ERGO_KERNEL(OmniBatch);
ERGO_CPU_KERNEL(OmniRayBatch);
ERGO_CPU_KERNEL(OmniNodeBatch);
ERGO_CPU_KERNEL(OmniCheckBatch);
ERGO_CPU_KERNEL(OmniLookUpBatch);
ERGO_CPU_KERNEL(OmniStarBatch<float>);
ERGO_CPU_KERNEL(OmniStarBatch<double>);

}  // namespace ergodome
