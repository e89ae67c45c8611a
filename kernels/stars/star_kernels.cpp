#include "kernels/launch/register.h"
#include "kernels/stars/observed_positions_kernel.h"
#include "kernels/stars/search/part_halving_kernel.h"
#include "kernels/stars/search/part_solving_kernel.h"
#include "kernels/stars/search/patch_measure_kernel.h"
#include "kernels/stars/search/patch_motion_kernel.h"
#include "kernels/stars/search/patch_pairs_kernel.h"
#include "kernels/stars/search/star_bands_kernel.h"
#include "kernels/stars/star_images_kernel.h"
#include "kernels/stars/star_points_kernel.h"

namespace ergodome {

ERGO_CPU_KERNEL(StarImageBatch<float>);
ERGO_CPU_KERNEL(StarImageBatch<double>);
ERGO_CPU_KERNEL(ObservedPositionBatch);
ERGO_CPU_KERNEL(PointLightBatch);
ERGO_CPU_KERNEL(StarSearchBatch);
ERGO_CPU_KERNEL(PatchMeasureBatch);
ERGO_CPU_KERNEL(PatchMotionBatch);
ERGO_CPU_KERNEL(PatchSideBatch);
ERGO_CPU_KERNEL(PatchNewtonBatch);
ERGO_CPU_KERNEL(SeePatchesBatch);
ERGO_CPU_KERNEL(HalvePartsBatch);
ERGO_CPU_KERNEL(SolvePartsBatch);

}  // namespace ergodome
