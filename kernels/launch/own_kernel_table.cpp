#include "kernels/core/host_device.h"
#include "kernels/eyes/omni/trace_omni_pixels_kernel.h"
#include "kernels/image/shade_pixels_kernel.h"
#include "kernels/launch/kernel_table.h"
#include "kernels/launch/own_disk_grid.h"
#include "kernels/launch/own_flat_eyes.h"
#include "kernels/launch/own_look_up.h"
#include "kernels/launch/own_near_field.h"
#include "kernels/launch/own_objects.h"
#include "kernels/launch/own_shading.h"
#include "kernels/launch/own_turning_eyes.h"
#include "kernels/launch/own_warping.h"
#include "kernels/lens/blend_check_kernel.h"
#include "kernels/lens/grid_build_kernel.h"
#include "kernels/lens/look_up_kernel.h"
#include "kernels/overlay/draw_overlay_kernel.h"
#include "kernels/published/quadtree_look_up_kernel.h"
#include "kernels/spacetime/trace/trace_pixels_kernel.h"
#include "kernels/spacetime/trace/trace_rays_kernel.h"
#include "kernels/stars/observed_places_kernel.h"
#include "kernels/stars/search/part_halving_kernel.h"
#include "kernels/stars/search/part_solving_kernel.h"
#include "kernels/stars/search/patch_measure_kernel.h"
#include "kernels/stars/search/patch_pairs_kernel.h"
#include "kernels/stars/star_bands_kernel.h"
#include "kernels/stars/star_images_kernel.h"

// Compiled once per instruction set; ERGO_TARGET names it.
namespace ergodome::inline ERGO_TARGET {

const KernelTable& own_kernel_table();

namespace {

template <class Functor, class Batch>
void run(const Batch& batch, int begin, int end) {
  const Functor functor{batch};
  for (int index = begin; index < end; ++index) {
    functor(index);
  }
}

template <class T>
void trace_rays(const RayBatch<ScalarOf<T>>& batch, int begin, int end) {
  dispatch_method(batch.method, [&](auto tracer) { run<TraceRays<decltype(tracer), T>>(batch, begin, end); });
}

void trace_pixels(const PixelBatch& batch, int begin, int end) {
  if (has_footprints(batch.out)) {
    run<TracePixels<WidePack<float>, true>>(batch, begin, end);
  } else {
    run<TracePixels<WidePack<float>, false>>(batch, begin, end);
  }
}

void trace_omni_pixels(const OmniBatch& batch, int begin, int end) {
  if (has_footprints(batch.pixels.out)) {
    run<TraceOmniPixels<WidePack<float>, true>>(batch, begin, end);
  } else {
    run<TraceOmniPixels<WidePack<float>, false>>(batch, begin, end);
  }
}

}  // namespace

const KernelTable& own_kernel_table() {
  static constexpr KernelTable table = {
      RealTraits<WidePack<float>>::lane_count,
      RealTraits<WidePack<double>>::lane_count,
      &trace_rays<WidePack<float>>,
      &trace_rays<WidePack<double>>,
      &trace_pixels,
      &trace_omni_pixels,
      &trace_omni_rays,
      &run<TraceNodes<WidePack<float>>, NodeBatch<float>>,
      &run<TraceNodes<WidePack<double>>, NodeBatch<double>>,
      &run<CheckCells<WidePack<float>>, CheckBatch<float>>,
      &run<CheckCells<WidePack<double>>, CheckBatch<double>>,
      &trace_omni_nodes,
      &check_omni_cells,
      &run<CheckBlend<WidePack<double>>, BlendCheckBatch>,
      &look_up_pixels,
      &look_up_pixel_pairs,
      &look_up_omni_pixels,
      &run<LookUpRays<WidePack<double>>, LookUpRaysBatch<double>>,
      &run<ReadQuadtreeRays, QuadtreeRaysBatch>,
      &run<ReadQuadtreePixels, QuadtreePixelBatch>,
      &run<FindStarImages<WidePack<float>>, StarImageBatch<float>>,
      &run<FindStarImages<WidePack<double>>, StarImageBatch<double>>,
      &find_omni_star_images,
      &find_omni_star_images,
      &run<MeasurePatch<WidePack<float>>, PatchMeasureBatch>,
      &run<ObservePlaces<WidePack<float>>, ObservedPlaceBatch>,
      &run<SearchStars<WidePack<float>>, StarSearchBatch>,
      &run<FindPatchSides<WidePack<float>>, PatchSideBatch>,
      &run<InvertPatches<WidePack<float>>, PatchNewtonBatch>,
      &run<SeePatches<WidePack<float>>, SeePatchesBatch>,
      &run<HalveParts<WidePack<float>>, HalvePartsBatch>,
      &run<SolveParts<WidePack<float>>, SolvePartsBatch>,
      &shade_sky,
      &run<ShadeHeatMap, ShadeBatch>,
      &draw_near_field,
      &draw_flat_eyes,
      &look_up_flat_eyes,
      &trace_disk_nodes,
      &check_disk_cells,
      &check_disk_grid,
      &look_up_disk,
      &mark_object_tiles,
      &look_at_objects,
      &mark_flat_object_tiles,
      &look_at_flat_objects,
      &run<DrawOverlay<WidePack<float>>, OverlayBatch>,
      &tone_tiles,
      &average_tiles,
      &warp_pixels,
  };
  return table;
}

}  // namespace ergodome::inline ERGO_TARGET
