#include "kernels/eyes/omni/trace_omni_pixels_kernel.h"
#include "kernels/launch/launch_cuda.cuh"
#include "kernels/launch/launch_cuda.h"
#include "kernels/spacetime/trace/trace_pixels_kernel.h"
#include "kernels/spacetime/trace/trace_rays_kernel.h"

namespace ergodome {

const char* find_cuda_unavailable_reason() {
  // Without a driver the runtime would report an insufficient driver; the driver version is then 0.
  int driver_version = 0;
  if (cudaDriverGetVersion(&driver_version) == cudaSuccess && driver_version == 0) {
    return "no NVIDIA driver is installed";
  }
  int count = 0;
  const cudaError_t code = cudaGetDeviceCount(&count);
  if (code == cudaErrorInsufficientDriver) {
    return "the NVIDIA driver is too old for the CUDA version that this program was built with; update it";
  }
  if (code != cudaSuccess && code != cudaErrorNoDevice) {
    return cudaGetErrorString(code);
  }
  return count > 0 ? nullptr : "no NVIDIA GPU was found";
}

void solve_edge_cuda(const EdgeBatch& batch) { launch_cuda("solve_edge", batch.count, SolveEdge{batch}); }

namespace {

template <class T>
void trace(const RayBatch<T>& batch) {
  dispatch_method(batch.method,
                  [&](auto tracer) { launch_cuda("trace_rays", batch.count, TraceRays<decltype(tracer), T>{batch}); });
}

}  // namespace

void trace_rays_cuda(const RayBatch<float>& batch) { trace(batch); }

void trace_rays_cuda(const RayBatch<double>& batch) { trace(batch); }

void trace_pixels_cuda(const PixelBatch& batch) {
  const auto launch = [&](const auto& trace) {
    launch_cuda_on_pixels("trace_pixels", batch.projection.width_px, batch.row_count, trace);
  };
  if (has_footprints(batch.out)) {
    launch(TracePixels<float, true>{batch});
  } else {
    launch(TracePixels<float, false>{batch});
  }
}

void trace_omni_pixels_cuda(const OmniBatch& batch) {
  const auto launch = [&](const auto& trace) {
    launch_cuda_on_pixels("trace_omni_pixels", batch.pixels.projection.width_px, batch.pixels.row_count, trace);
  };
  if (has_footprints(batch.pixels.out)) {
    launch(TraceOmniPixels<float, true>{batch});
  } else {
    launch(TraceOmniPixels<float, false>{batch});
  }
}

}  // namespace ergodome
