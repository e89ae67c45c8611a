#include "kernels/launch/register.h"
#include "kernels/stars/draw_stars_kernel.h"
#include "kernels/stars/search/patch_search_kernel.h"
#include "kernels/stars/search/star_twins_kernel.h"
#include "kernels/stars/star_points_kernel.h"

namespace ergodome {

ERGO_KERNEL(PatchSearchBatch);
ERGO_KERNEL(StarTwinBatch);
ERGO_KERNEL(StarPointBatch);
ERGO_CPU_KERNEL(StarTileBatch);
ERGO_CPU_KERNEL(StarLightBatch);

}  // namespace ergodome
