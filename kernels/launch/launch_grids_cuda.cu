#include "kernels/launch/launch_cuda.cuh"
#include "kernels/launch/launch_cuda.h"
#include "kernels/lens/grid_build_kernel.h"
#include "kernels/lens/look_up_kernel.h"
#include "kernels/lens/quadtree_look_up_kernel.h"

// The kernels of lens grids, in a file of their own: the compiler takes minutes for each.
namespace ergodome {

void trace_nodes_cuda(const NodeBatch<float>& batch) {
  launch_cuda("trace_nodes", batch.count, TraceNodes<float>{batch});
}

void check_cells_cuda(const CheckBatch<float>& batch) {
  launch_cuda("check_cells", batch.count, CheckCells<float>{batch});
}

void look_up_pixels_cuda(const LookUpBatch& batch) {
  const int count = batch.pixels.row_count * batch.pixels.projection.width_px;
  if (has_footprints(batch.pixels.out)) {
    launch_cuda("look_up_pixels", count, LookUpPixels<float, true>{batch});
  } else {
    launch_cuda("look_up_pixels", count, LookUpPixels<float, false>{batch});
  }
}

void look_up_rays_cuda(const LookUpRaysBatch<double>& batch) {
  launch_cuda("look_up_rays", batch.rays.count, LookUpRays<double>{batch});
}

void read_quadtree_rays_cuda(const QuadtreeRaysBatch& batch) {
  launch_cuda("read_quadtree_rays", batch.rays.count, ReadQuadtreeRays{batch});
}

}  // namespace ergodome
