#pragma once

#include "kernels/disk/disk_grid.h"
#include "kernels/eyes/flat/draw_flat_eyes.h"
#include "kernels/eyes/omni/omni_batches.h"
#include "kernels/eyes/omni/omni_camera.h"
#include "kernels/image/shade_pixels.h"
#include "kernels/image/warp_pixels.h"
#include "kernels/launch/instruction_set.h"
#include "kernels/lens/blend_check.h"
#include "kernels/lens/grid_build.h"
#include "kernels/lens/look_up.h"
#include "kernels/near_field/draw_near_field.h"
#include "kernels/objects/draw_objects.h"
#include "kernels/overlay/draw_overlay.h"
#include "kernels/published/quadtree_look_up.h"
#include "kernels/spacetime/trace/trace_pixels.h"
#include "kernels/spacetime/trace/trace_rays.h"
#include "kernels/stars/observed_places.h"
#include "kernels/stars/search/patch_measure.h"
#include "kernels/stars/search/patch_pairs.h"
#include "kernels/stars/search/seen_parts.h"
#include "kernels/stars/star_bands.h"
#include "kernels/stars/star_images.h"

// Tables of CPU kernels, one for each instruction set.
namespace ergodome {

//! The CPU kernels of one instruction set. Each runs the indices [begin, end); an index covers
//! `lanes` elements.
struct KernelTable {
  int lanes_float;
  int lanes_double;
  void (*trace_rays_float)(const RayBatch<float>& batch, int begin, int end);
  void (*trace_rays_double)(const RayBatch<double>& batch, int begin, int end);
  void (*trace_pixels)(const PixelBatch& batch, int begin, int end);
  void (*trace_omni_pixels)(const OmniBatch& batch, int begin, int end);
  void (*trace_omni_rays)(const OmniRayBatch& batch, int begin, int end);
  void (*trace_nodes_float)(const NodeBatch<float>& batch, int begin, int end);
  void (*trace_nodes_double)(const NodeBatch<double>& batch, int begin, int end);
  void (*check_cells_float)(const CheckBatch<float>& batch, int begin, int end);
  void (*check_cells_double)(const CheckBatch<double>& batch, int begin, int end);
  void (*trace_omni_nodes)(const OmniNodeBatch& batch, int begin, int end);
  void (*check_omni_cells)(const OmniCheckBatch& batch, int begin, int end);
  void (*check_blend)(const BlendCheckBatch& batch, int begin, int end);
  void (*look_up_pixels)(const LookUpBatch& batch, int begin, int end);
  void (*look_up_pixel_pairs)(const LookUpPairBatch& batch, int begin, int end);
  void (*look_up_omni_pixels)(const OmniLookUpBatch& batch, int begin, int end);
  void (*look_up_rays)(const LookUpRaysBatch<double>& batch, int begin, int end);
  //! One element per index.
  void (*read_quadtree_rays)(const QuadtreeRaysBatch& batch, int begin, int end);
  void (*read_quadtree_pixels)(const QuadtreePixelBatch& batch, int begin, int end);
  void (*find_star_images_float)(const StarImageBatch<float>& batch, int begin, int end);
  void (*find_star_images_double)(const StarImageBatch<double>& batch, int begin, int end);
  void (*find_omni_star_images_float)(const OmniStarBatch<float>& batch, int begin, int end);
  void (*find_omni_star_images_double)(const OmniStarBatch<double>& batch, int begin, int end);
  void (*measure_patch)(const PatchMeasureBatch& batch, int begin, int end);  //!< only index 0
  void (*observe_places)(const ObservedPlaceBatch& batch, int begin, int end);
  void (*search_stars)(const StarSearchBatch& batch, int begin, int end);  //!< only index 0
  void (*find_patch_sides)(const PatchSideBatch& batch, int begin, int end);
  void (*invert_patches)(const PatchNewtonBatch& batch, int begin, int end);
  void (*see_patches)(const SeePatchesBatch& batch, int begin, int end);
  void (*halve_parts)(const HalvePartsBatch& batch, int begin, int end);
  void (*solve_parts)(const SolvePartsBatch& batch, int begin, int end);
  void (*shade_sky)(const ShadeBatch& batch, int begin, int end);
  void (*shade_heat_map)(const ShadeBatch& batch, int begin, int end);  //!< one element per index
  void (*draw_near_field)(const NearFieldBatch& batch, int begin, int end);
  void (*draw_flat_eyes)(const FlatEyeBatch& batch, int begin, int end);
  void (*look_up_flat_eyes)(const FlatEyeLookUpBatch& batch, int begin, int end);
  void (*trace_disk_nodes)(const DiskNodeBatch& batch, int begin, int end);
  void (*check_disk_cells)(const DiskCheckBatch& batch, int begin, int end);
  void (*check_disk_grid)(const DiskGridCheckBatch& batch, int begin, int end);
  void (*look_up_disk)(const DiskLookUpBatch& batch, int begin, int end);
  void (*mark_object_tiles)(const ObjectTileBatch& batch, int begin, int end);
  void (*look_at_objects)(const ObjectPixelBatch& batch, int begin, int end);
  void (*mark_flat_object_tiles)(const FlatObjectTileBatch& batch, int begin, int end);
  void (*look_at_flat_objects)(const FlatObjectPixelBatch& batch, int begin, int end);
  void (*draw_overlay)(const OverlayBatch& batch, int begin, int end);
  void (*tone_tiles)(const ToneBatch& batch, int begin, int end);        //!< one tile per index
  void (*average_tiles)(const AverageBatch& batch, int begin, int end);  //!< one tile per index
  void (*warp_pixels)(const WarpBatch& batch, int begin, int end);       //!< one group per index
};

//! Returns the kernels compiled for an instruction set, for which has_instruction_set() must be
//! true.
const KernelTable& kernel_table(InstructionSet set);

}  // namespace ergodome
