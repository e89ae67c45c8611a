#include "kernels/core/error.h"
#include "kernels/launch/launch_cuda.h"

namespace ergodome {

namespace {

[[noreturn]] void refuse() { throw Error("CUDA", "this program was built without CUDA", "run with --backend cpu"); }

}  // namespace

const char* find_cuda_unavailable_reason() { return "this program was built without CUDA"; }

void trace_rays_cuda(const RayBatch<float>&) { refuse(); }

void trace_rays_cuda(const RayBatch<double>&) { refuse(); }

void trace_pixels_cuda(const PixelBatch&) { refuse(); }

void trace_omni_pixels_cuda(const OmniBatch&) { refuse(); }

void trace_nodes_cuda(const NodeBatch<float>&) { refuse(); }

void check_cells_cuda(const CheckBatch<float>&) { refuse(); }

void look_up_pixels_cuda(const LookUpBatch&) { refuse(); }

void look_up_rays_cuda(const LookUpRaysBatch<double>&) { refuse(); }

void read_quadtree_rays_cuda(const QuadtreeRaysBatch&) { refuse(); }

void shade_pixels_cuda(const ShadeBatch&) { refuse(); }

void draw_near_field_cuda(const NearFieldBatch&) { refuse(); }

void draw_flat_eyes_cuda(const FlatEyeBatch&) { refuse(); }

void mark_object_tiles_cuda(const ObjectTileBatch&) { refuse(); }

void look_at_objects_cuda(const ObjectPixelBatch&) { refuse(); }
void mark_flat_object_tiles_cuda(const FlatObjectTileBatch&) { refuse(); }
void look_at_flat_objects_cuda(const FlatObjectPixelBatch&) { refuse(); }

void lay_objects_cuda(const LayObjectsBatch&) { refuse(); }

void join_star_images_cuda(const StarTwinBatch&, StarTwinStep) { refuse(); }

void place_star_images_cuda(const StarPointBatch&, int) { refuse(); }

void place_stars_cuda(const StarTileBatch&, StarTileStep) { refuse(); }

void sum_counts_cuda(const std::int32_t*, int, std::int32_t*) { refuse(); }

void draw_stars_cuda(const StarLightBatch&) { refuse(); }

void search_patches_cuda(const PatchSearchBatch&, PatchSearchStep, int, int) { refuse(); }

void draw_overlay_cuda(const OverlayBatch&) { refuse(); }

void tone_tiles_cuda(const ToneBatch&) { refuse(); }

void average_tiles_cuda(const AverageBatch&) { refuse(); }

void warp_pixels_cuda(const WarpBatch&) { refuse(); }

void wait_for_cuda() { refuse(); }

void solve_edge_cuda(const EdgeBatch&) { refuse(); }

long count_negative_cuda(const float*, long) { refuse(); }

bool begin_in_order_cuda() { refuse(); }

void end_in_order_cuda(bool, bool) {}

void* begin_urgent_cuda() { refuse(); }

void end_urgent_cuda(void*) {}

void* allocate_cuda(std::size_t) { refuse(); }

void release_cuda(void*) noexcept {}

void clear_cuda(void*, std::size_t) { refuse(); }

void copy_to_cuda(void*, const void*, std::size_t) { refuse(); }

void copy_from_cuda(void*, const void*, std::size_t) { refuse(); }

}  // namespace ergodome
