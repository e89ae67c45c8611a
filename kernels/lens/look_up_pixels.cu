#include "kernels/launch/launch_on_cuda.cuh"
#include "kernels/lens/look_up_kernel.h"

// Reads pixels from lens grids on a GPU.
namespace ergodome {

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
                         // Two blocks for each of the 132 multiprocessors of a large GPU: as many
                         // as fit with the registers that the kernel needs.
                         constexpr int blocks = 264;
                         run_functor_on_listed<<<blocks, pixel_block, 0, current_stream()>>>(functor, listed, count);
                       });
}

}  // namespace

template <>
void launch_on_cuda(const LookUpBatch& batch) {
  if (has_footprints(batch.pixels.out)) {
    look_up(batch.pixels, LookUpPixels<float, true>{batch});
  } else {
    look_up(batch.pixels, LookUpPixels<float, false>{batch});
  }
}

}  // namespace ergodome
