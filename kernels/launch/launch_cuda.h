#pragma once

#include <cstddef>

#include "kernels/eyes/flat/draw_flat_eyes.h"
#include "kernels/eyes/omni/omni_camera.h"
#include "kernels/image/shade_pixels.h"
#include "kernels/image/warp_pixels.h"
#include "kernels/lens/grid_build.h"
#include "kernels/lens/look_up.h"
#include "kernels/near_field/draw_near_field.h"
#include "kernels/objects/draw_objects.h"
#include "kernels/overlay/draw_overlay.h"
#include "kernels/published/quadtree_look_up.h"
#include "kernels/spacetime/shadow/edge_kernel.h"
#include "kernels/spacetime/trace/trace_pixels.h"
#include "kernels/spacetime/trace/trace_rays.h"
#include "kernels/stars/draw_stars.h"
#include "kernels/stars/search/patch_search.h"
#include "kernels/stars/search/star_twins.h"
#include "kernels/stars/star_sheet.h"

namespace ergodome {

// The device side of kernels/launch/launch.h: defined in launch_cuda.cu and others, or in
// launch_without_cuda.cpp if there is no CUDA toolkit.

const char* find_cuda_unavailable_reason();
void trace_rays_cuda(const RayBatch<float>& batch);
void trace_rays_cuda(const RayBatch<double>& batch);
void trace_pixels_cuda(const PixelBatch& batch);
void trace_omni_pixels_cuda(const OmniBatch& batch);
void trace_nodes_cuda(const NodeBatch<float>& batch);
void check_cells_cuda(const CheckBatch<float>& batch);
void look_up_pixels_cuda(const LookUpBatch& batch);
void look_up_rays_cuda(const LookUpRaysBatch<double>& batch);
void read_quadtree_rays_cuda(const QuadtreeRaysBatch& batch);
void shade_pixels_cuda(const ShadeBatch& batch);
void draw_near_field_cuda(const NearFieldBatch& batch);
void draw_flat_eyes_cuda(const FlatEyeBatch& batch);
void mark_object_tiles_cuda(const ObjectTileBatch& batch);
void look_at_objects_cuda(const ObjectPixelBatch& batch);
void mark_flat_object_tiles_cuda(const FlatObjectTileBatch& batch);
void look_at_flat_objects_cuda(const FlatObjectPixelBatch& batch);
void lay_objects_cuda(const LayObjectsBatch& batch);
void join_star_images_cuda(const StarTwinBatch& batch, StarTwinStep step);
void place_star_images_cuda(const StarPointBatch& batch, int count);
void place_stars_cuda(const StarTileBatch& batch, StarTileStep step);
void sum_counts_cuda(const std::int32_t* counts, int count, std::int32_t* sums);
void draw_stars_cuda(const StarLightBatch& batch);
void search_patches_cuda(const PatchSearchBatch& batch, PatchSearchStep step, int count, int depth);
void draw_overlay_cuda(const OverlayBatch& batch);
void tone_tiles_cuda(const ToneBatch& batch);
void average_tiles_cuda(const AverageBatch& batch);
void warp_pixels_cuda(const WarpBatch& batch);
void wait_for_cuda();
void solve_edge_cuda(const EdgeBatch& batch);
long count_negative_cuda(const float* values, long count);
bool begin_in_order_cuda();
void end_in_order_cuda(bool before, bool may_throw);
void* begin_urgent_cuda();
void end_urgent_cuda(void* before);
void* allocate_cuda(std::size_t bytes);
void release_cuda(void* memory) noexcept;
void clear_cuda(void* memory, std::size_t bytes);
void copy_to_cuda(void* to, const void* from, std::size_t bytes);
void copy_from_cuda(void* to, const void* from, std::size_t bytes);

}  // namespace ergodome
