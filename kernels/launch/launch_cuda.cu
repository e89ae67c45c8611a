#include "kernels/launch/launch_cuda.cuh"
#include "kernels/launch/launch_cuda.h"
#include "kernels/trace/trace_omni_pixels_kernel.h"
#include "kernels/trace/trace_pixels_kernel.h"
#include "kernels/trace/trace_rays_kernel.h"

namespace ergodome {

const char* find_cuda_unavailable_reason() {
  int count = 0;
  const cudaError_t code = cudaGetDeviceCount(&count);
  if (code != cudaSuccess) {
    return cudaGetErrorString(code);
  }
  return count > 0 ? nullptr : "no CUDA device";
}

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
  const int count = batch.row_count * batch.projection.width_px;
  if (has_footprints(batch.out)) {
    launch_cuda("trace_pixels", count, TracePixels<float, true>{batch});
  } else {
    launch_cuda("trace_pixels", count, TracePixels<float, false>{batch});
  }
}

void trace_omni_pixels_cuda(const OmniBatch& batch) {
  const int count = batch.pixels.row_count * batch.pixels.projection.width_px;
  if (has_footprints(batch.pixels.out)) {
    launch_cuda("trace_omni_pixels", count, TraceOmniPixels<float, true>{batch});
  } else {
    launch_cuda("trace_omni_pixels", count, TraceOmniPixels<float, false>{batch});
  }
}

void* allocate_cuda(std::size_t bytes) {
  void* memory = nullptr;
  check_cuda(cudaMalloc(&memory, bytes), "cudaMalloc");
  return memory;
}

void release_cuda(void* memory) noexcept { cudaFree(memory); }

namespace {

//! A stream of the calling thread's own: a reader's uploads and the pictures in flight do not wait for each other.
class UploadStream {
 public:
  UploadStream() { check_cuda(cudaStreamCreateWithFlags(&handle_, cudaStreamNonBlocking), "making a stream"); }
  ~UploadStream() { cudaStreamDestroy(handle_); }
  UploadStream(const UploadStream&) = delete;
  UploadStream& operator=(const UploadStream&) = delete;

  [[nodiscard]] cudaStream_t handle() const { return handle_; }

 private:
  cudaStream_t handle_ = nullptr;
};

}  // namespace

void copy_to_cuda(void* to, const void* from, std::size_t bytes) {
  thread_local const UploadStream stream;
  check_cuda(cudaMemcpyAsync(to, from, bytes, cudaMemcpyHostToDevice, stream.handle()), "copy to the device");
  check_cuda(cudaStreamSynchronize(stream.handle()), "copy to the device");
}

void copy_from_cuda(void* to, const void* from, std::size_t bytes) {
  check_cuda(cudaMemcpy(to, from, bytes, cudaMemcpyDeviceToHost), "copy from the device");
}

}  // namespace ergodome
