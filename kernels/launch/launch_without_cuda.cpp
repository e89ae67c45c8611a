#include "kernels/core/error.h"
#include "kernels/launch/launch_cuda.h"

namespace ergodome {

namespace {

[[noreturn]] void refuse() {
  throw Error("CUDA", "this program was built without CUDA", "run with --backend cpu");
}

}  // namespace

const char* find_cuda_unavailable_reason() { return "this program was built without CUDA"; }

void trace_rays_cuda(const RayBatch<float>&) { refuse(); }

void trace_rays_cuda(const RayBatch<double>&) { refuse(); }

void trace_pixels_cuda(const PixelBatch&) { refuse(); }

void shade_pixels_cuda(const ShadeBatch&) { refuse(); }

}  // namespace ergodome
