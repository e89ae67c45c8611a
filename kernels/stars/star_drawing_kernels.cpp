#include "kernels/launch/register.h"
#include "kernels/stars/draw_stars_kernel.h"
#include "kernels/stars/search/image_join_kernel.h"
#include "kernels/stars/search/patch_search_kernel.h"
#include "kernels/stars/star_points_kernel.h"

namespace ergodome {

ERGO_KERNEL(ImageJoinBatch);
ERGO_KERNEL(PatchSearchBatch);
ERGO_KERNEL(StarPointBatch);
ERGO_CPU_KERNEL(StarTileBatch);
ERGO_CPU_KERNEL(StarLightBatch);

}  // namespace ergodome
