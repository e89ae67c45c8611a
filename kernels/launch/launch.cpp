#include "kernels/launch/launch.h"

#include "kernels/launch/launch_cuda.h"
#include "kernels/launch/run_on_cpu.h"

namespace ergodome {

const char* cuda_unavailable_reason() {
  static const char* const reason = find_cuda_unavailable_reason();
  return reason;
}

void trace_rays(Backend backend, const RayBatch<float>& batch) {
  static WorkCounter counter("trace_rays");
  const WorkScope work(counter, batch.count);
  if (backend == Backend::cuda) {
    trace_rays_cuda(batch);
  } else {
    run_on_cpu(active_table().trace_rays_float, batch, batch.count, active_table().lanes_float);
  }
  finish(counter, backend, batch);
}

void trace_rays(Backend backend, const RayBatch<double>& batch) {
  static WorkCounter counter("trace_rays, double");
  const WorkScope work(counter, batch.count);
  if (backend == Backend::cuda) {
    trace_rays_cuda(batch);
  } else {
    run_on_cpu(active_table().trace_rays_double, batch, batch.count, active_table().lanes_double);
  }
  finish(counter, backend, batch);
}

void trace_pixels(Backend backend, const PixelBatch& batch) {
  const int pixels = batch.row_count * batch.projection.width_px;
  static WorkCounter plain("trace_pixels");
  static WorkCounter with_footprints("trace_pixels, footprints");
  WorkCounter& counter = has_footprints(batch.out) ? with_footprints : plain;
  const WorkScope work(counter, pixels);
  if (backend == Backend::cuda) {
    trace_pixels_cuda(batch);
  } else {
    run_on_cpu(active_table().trace_pixels, batch, pixels, active_table().lanes_float);
  }
  finish(counter, backend, batch);
}

void trace_omni_pixels(Backend backend, const OmniBatch& batch) {
  const int pixels = batch.pixels.row_count * batch.pixels.projection.width_px;
  static WorkCounter plain("trace_omni_pixels");
  static WorkCounter with_footprints("trace_omni_pixels, footprints");
  WorkCounter& counter = has_footprints(batch.pixels.out) ? with_footprints : plain;
  const WorkScope work(counter, pixels);
  if (backend == Backend::cuda) {
    trace_omni_pixels_cuda(batch);
  } else {
    run_on_cpu(active_table().trace_omni_pixels, batch, pixels, active_table().lanes_float);
  }
  finish(counter, backend, batch);
}

void trace_rays(const OmniRayBatch& batch) {
  static WorkCounter counter("trace_rays, double");
  const WorkScope work(counter, batch.rays.count);
  run_on_cpu(active_table().trace_omni_rays, batch, batch.rays.count, active_table().lanes_double);
  finish(counter, Backend::cpu, batch.rays);
}

void trace_nodes(Backend backend, const NodeBatch<float>& batch) {
  static WorkCounter counter("trace_nodes");
  const WorkScope work(counter, batch.count);
  if (backend == Backend::cuda) {
    trace_nodes_cuda(batch);
  } else {
    run_on_cpu(active_table().trace_nodes_float, batch, batch.count, active_table().lanes_float, grid_grain);
  }
  finish(counter, backend, batch);
}

void trace_nodes(const NodeBatch<double>& batch) {
  static WorkCounter counter("trace_nodes, double");
  const WorkScope work(counter, batch.count);
  run_on_cpu(active_table().trace_nodes_double, batch, batch.count, active_table().lanes_double, grid_grain);
  finish(counter, Backend::cpu, batch);
}

void check_cells(Backend backend, const CheckBatch<float>& batch) {
  static WorkCounter counter("check_cells");
  const WorkScope work(counter, batch.count);
  if (backend == Backend::cuda) {
    check_cells_cuda(batch);
  } else {
    run_on_cpu(active_table().check_cells_float, batch, batch.count, active_table().lanes_float, grid_grain);
  }
  finish(counter, backend, batch);
}

void check_cells(const CheckBatch<double>& batch) {
  static WorkCounter counter("check_cells, double");
  const WorkScope work(counter, batch.count);
  run_on_cpu(active_table().check_cells_double, batch, batch.count, active_table().lanes_double, grid_grain);
  finish(counter, Backend::cpu, batch);
}

void trace_nodes(const OmniNodeBatch& batch) {
  static WorkCounter counter("trace_nodes");
  const WorkScope work(counter, batch.count);
  run_on_cpu(active_table().trace_omni_nodes, batch, batch.count, active_table().lanes_float, grid_grain);
  finish(counter, Backend::cpu, batch);
}

void check_cells(const OmniCheckBatch& batch) {
  static WorkCounter counter("check_cells");
  const WorkScope work(counter, batch.count);
  run_on_cpu(active_table().check_omni_cells, batch, batch.count, active_table().lanes_float, grid_grain);
  finish(counter, Backend::cpu, batch);
}

void check_blend(const BlendCheckBatch& batch) {
  static WorkCounter counter("check_blend");
  const WorkScope work(counter, batch.count);
  run_on_cpu(active_table().check_blend, batch, batch.count, active_table().lanes_double, grid_grain);
  finish(counter, Backend::cpu, batch);
}

namespace {
WorkCounter& look_up_counter(const LookUpBatch& batch) {
  static WorkCounter plain("look_up_pixels");
  static WorkCounter with_footprints("look_up_pixels, footprints");
  return has_footprints(batch.pixels.out) ? with_footprints : plain;
}
}  // namespace

void look_up_pixels(Backend backend, const LookUpBatch& batch) {
  const int pixels = batch.pixels.row_count * batch.pixels.projection.width_px;
  WorkCounter& counter = look_up_counter(batch);
  const WorkScope work(counter, pixels);
  if (backend == Backend::cuda) {
    look_up_pixels_cuda(batch);
  } else {
    run_on_cpu(active_table().look_up_pixels, batch, pixels, active_table().lanes_float);
  }
  finish(counter, backend, batch);
}

void look_up_pixels(const LookUpPairBatch& batch) {
  const PixelBatch& first = batch.eyes[0].pixels;
  const int pixels = first.row_count * first.projection.width_px;
  WorkCounter& counter = look_up_counter(batch.eyes[0]);
  // Count one picture per eye, like two separate launches.
  counter.count(pixels);
  const WorkScope work(counter, pixels);
  run_on_cpu(active_table().look_up_pixel_pairs, batch, pixels, active_table().lanes_float);
  for (const LookUpBatch& eye : batch.eyes) {
    finish(counter, Backend::cpu, eye);
  }
}

void look_up_pixels(const OmniLookUpBatch& batch) {
  const int pixels = batch.pixels.row_count * batch.pixels.projection.width_px;
  static WorkCounter plain("look_up_omni_pixels");
  static WorkCounter with_footprints("look_up_omni_pixels, footprints");
  WorkCounter& counter = has_footprints(batch.pixels.out) ? with_footprints : plain;
  const WorkScope work(counter, pixels);
  run_on_cpu(active_table().look_up_omni_pixels, batch, pixels, active_table().lanes_float);
  finish(counter, Backend::cpu, batch);
}

void look_up_rays(Backend backend, const LookUpRaysBatch<double>& batch) {
  static WorkCounter counter("look_up_rays");
  const WorkScope work(counter, batch.rays.count);
  if (backend == Backend::cuda) {
    look_up_rays_cuda(batch);
  } else {
    run_on_cpu(active_table().look_up_rays, batch, batch.rays.count, active_table().lanes_double);
  }
  finish(counter, backend, batch);
}

void read_quadtree_rays(Backend backend, const QuadtreeRaysBatch& batch) {
  static WorkCounter counter("read_quadtree_rays");
  const WorkScope work(counter, batch.rays.count);
  if (backend == Backend::cuda) {
    read_quadtree_rays_cuda(batch);
  } else {
    run_on_cpu(active_table().read_quadtree_rays, batch, batch.rays.count, 1, 16 * grain);
  }
  finish(counter, backend, batch);
}

void read_quadtree_pixels(const QuadtreePixelBatch& batch) {
  const int pixels = batch.pixels.row_count * batch.pixels.projection.width_px;
  static WorkCounter counter("read_quadtree_pixels");
  const WorkScope work(counter, pixels);
  run_on_cpu(active_table().read_quadtree_pixels, batch, pixels, 1, 16 * grain);
  finish(counter, Backend::cpu, batch);
}

StarImageLanes star_image_lanes() { return {active_table().lanes_float, active_table().lanes_double}; }

void find_star_images(const StarImageBatch<float>& batch) {
  active_table().find_star_images_float(batch, 0, index_count(batch.count, active_table().lanes_float));
}

void find_star_images(const StarImageBatch<double>& batch) {
  active_table().find_star_images_double(batch, 0, index_count(batch.count, active_table().lanes_double));
}

void find_star_images(const OmniStarBatch<float>& batch) {
  active_table().find_omni_star_images_float(batch, 0, index_count(batch.count, active_table().lanes_float));
}

void find_star_images(const OmniStarBatch<double>& batch) {
  active_table().find_omni_star_images_double(batch, 0, index_count(batch.count, active_table().lanes_double));
}

void measure_patch(const PatchMeasureBatch& batch) { active_table().measure_patch(batch, 0, 1); }

void search_stars(const StarSearchBatch& batch) { active_table().search_stars(batch, 0, 1); }

void find_patch_sides(const PatchSideBatch& batch) {
  active_table().find_patch_sides(batch, 0, index_count(batch.pairs.count, active_table().lanes_float));
}

void invert_patches(const PatchNewtonBatch& batch) {
  active_table().invert_patches(batch, 0, index_count(batch.pairs.count, active_table().lanes_float));
}

void see_patches(const SeePatchesBatch& batch) {
  active_table().see_patches(batch, 0, index_count(batch.pairs.count, active_table().lanes_float));
}

void halve_parts(const HalvePartsBatch& batch) { active_table().halve_parts(batch, 0, 1); }

void solve_parts(const SolvePartsBatch& batch) {
  active_table().solve_parts(batch, 0, index_count(batch.parts.count, active_table().lanes_float));
}

void observe_places(const ObservedPlaceBatch& batch) {
  active_table().observe_places(batch, 0, index_count(batch.count, active_table().lanes_float));
}

std::string shading_name(SkyFilter filter, SkyShift shift, bool brightening) {
  constexpr const char* filters[] = {"", ", point", ", polygon"};
  constexpr const char* shifts[] = {"", ", luminance", ", blackbody_fit"};
  return std::string("shade_sky") + filters[static_cast<int>(filter)] + shifts[static_cast<int>(shift)] +
         (brightening ? ", brightening" : "");
}

void shade_pixels(Backend backend, const ShadeBatch& batch) {
  const bool sky = batch.mode == ViewMode::sky;
  WorkCounter& counter =
      work_counter(sky ? shading_name(batch.filter, batch.shift, batch.brightening) : "shade_heat_map");
  const WorkScope work(counter, batch.count);
  if (backend == Backend::cuda) {
    shade_pixels_cuda(batch);
  } else if (sky) {
    run_on_cpu(active_table().shade_sky, batch, batch.count, active_table().lanes_float);
  } else {
    run_on_cpu(active_table().shade_heat_map, batch, batch.count, 1, 16 * grain);
  }
  finish(counter, backend, batch);
}

void draw_overlay(Backend backend, const OverlayBatch& batch) {
  static WorkCounter counter("draw_overlay");
  const WorkScope work(counter, batch.count);
  if (backend == Backend::cuda) {
    draw_overlay_cuda(batch);
  } else {
    run_on_cpu(active_table().draw_overlay, batch, batch.count, active_table().lanes_float);
  }
  finish(counter, backend, batch);
}

void tone_tiles(Backend backend, const ToneBatch& batch) {
  static WorkCounter counter("tone_tiles");
  const WorkScope work(counter, batch.count);
  if (backend == Backend::cuda) {
    tone_tiles_cuda(batch);
  } else {
    run_on_cpu(active_table().tone_tiles, batch, batch.count, 1, grid_grain);
  }
}

void average_tiles(Backend backend, const AverageBatch& batch) {
  static WorkCounter counter("average_tiles");
  const WorkScope work(counter, batch.count);
  if (backend == Backend::cuda) {
    average_tiles_cuda(batch);
  } else {
    run_on_cpu(active_table().average_tiles, batch, batch.count, 1, grid_grain);
  }
}

void warp_pixels(Backend backend, const WarpBatch& batch) {
  static WorkCounter counter("warp_pixels");
  const WorkScope work(counter, static_cast<long>(batch.width_px) * batch.height_px);
  if (backend == Backend::cuda) {
    warp_pixels_cuda(batch);
  } else {
    const int groups = warp_groups(batch.width_px) * batch.height_px;
    run_on_cpu(active_table().warp_pixels, batch, groups, 1, 16 * grain);
  }
}

void wait_for_device(Backend backend) {
  if (backend == Backend::cuda) {
    wait_for_cuda();
  }
}

}  // namespace ergodome
