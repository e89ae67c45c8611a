#include "kernels/launch/launch_cuda.h"
#include "kernels/launch/launch_in_steps_cuda.cuh"
#include "kernels/lens/grid_build_kernel.h"
#include "kernels/lens/look_up_kernel.h"
#include "kernels/published/quadtree_look_up_kernel.h"

// The kernels of lens grids, in a separate file because the compiler takes minutes for each.
namespace ergodome {

void trace_nodes_cuda(const NodeBatch<float>& batch) {
  launch_cuda("trace_nodes", batch.count, TraceNodes<float>{batch});
}

void check_cells_cuda(const CheckBatch<float>& batch) {
  launch_cuda("check_cells", batch.count, CheckCells<float>{batch});
}

namespace {

template <class Functor>
struct LookUpAlone {
  Functor functor;
  __device__ bool operator()(int index) const { return functor.look_up_alone(index); }
};

template <class Functor>
void look_up(const PixelBatch& pixels, const Functor& functor) {
  launch_cuda_in_steps("look_up_pixels", pixels.projection.width_px, pixels.row_count, LookUpAlone<Functor>{functor},
                       [&](const int* listed, const int* count) {
                         // With this many registers, two blocks fit on each multiprocessor of a
                         // large device.
                         constexpr int blocks = 264;
                         run_functor_on_listed<<<blocks, pixel_block, 0, current_stream()>>>(functor, listed, count);
                       });
}

}  // namespace

void look_up_pixels_cuda(const LookUpBatch& batch) {
  if (has_footprints(batch.pixels.out)) {
    look_up(batch.pixels, LookUpPixels<float, true>{batch});
  } else {
    look_up(batch.pixels, LookUpPixels<float, false>{batch});
  }
}

void look_up_rays_cuda(const LookUpRaysBatch<double>& batch) {
  launch_cuda("look_up_rays", batch.rays.count, LookUpRays<double>{batch});
}

void read_quadtree_rays_cuda(const QuadtreeRaysBatch& batch) {
  launch_cuda("read_quadtree_rays", batch.rays.count, ReadQuadtreeRays{batch});
}

}  // namespace ergodome
