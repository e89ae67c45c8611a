#include "kernels/launch/own_turning_eyes.h"

#include "kernels/lens/grid_build_kernel.h"
#include "kernels/lens/look_up_kernel.h"
#include "kernels/spacetime/trace/trace_rays_kernel.h"
#include "kernels/stars/star_images_kernel.h"

// Compiled once per instruction set; ERGO_TARGET names it.
namespace ergodome::inline ERGO_TARGET {

namespace {

template <class Functor, class Batch>
void run(const Batch& batch, int begin, int end) {
  const Functor functor{batch};
  for (int index = begin; index < end; ++index) {
    functor(index);
  }
}

}  // namespace

void trace_omni_rays(const OmniRayBatch& batch, int begin, int end) {
  run<TraceOmniRays<WidePack<double>>>(batch, begin, end);
}

void trace_omni_nodes(const OmniNodeBatch& batch, int begin, int end) {
  run<TraceNodes<WidePack<float>, OmniCameraOf<float>>>(batch, begin, end);
}

void check_omni_cells(const OmniCheckBatch& batch, int begin, int end) {
  run<CheckCells<WidePack<float>, OmniCameraOf<float>>>(batch, begin, end);
}

void look_up_omni_pixels(const OmniLookUpBatch& batch, int begin, int end) {
  if (has_footprints(batch.pixels.out)) {
    run<LookUpPixels<WidePack<float>, true, OmniLookUpBatch>>(batch, begin, end);
  } else {
    run<LookUpPixels<WidePack<float>, false, OmniLookUpBatch>>(batch, begin, end);
  }
}

void find_omni_star_images(const OmniStarBatch<float>& batch, int begin, int end) {
  run<FindStarImages<WidePack<float>, OmniCameraOf<float>>>(batch, begin, end);
}

void find_omni_star_images(const OmniStarBatch<double>& batch, int begin, int end) {
  run<FindStarImages<WidePack<double>, OmniCameraOf<double>>>(batch, begin, end);
}

}  // namespace ergodome::inline ERGO_TARGET
