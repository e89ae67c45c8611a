#include <cub/device/device_scan.cuh>

#include "kernels/launch/launch_on_cuda.cuh"

// Finds the GPU, waits for it, and reduces arrays in its memory.
namespace ergodome {

namespace {

const char* find_unavailable_reason() {
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

__global__ void count_negative_values(const float* values, long count, unsigned long long* sum) {
  const long at = static_cast<long>(blockIdx.x) * blockDim.x + threadIdx.x;
  const unsigned found = __ballot_sync(0xffffffffU, at < count && values[at] < 0.0F);
  if (threadIdx.x % 32 == 0 && found != 0U) {
    atomicAdd(sum, static_cast<unsigned long long>(__popc(found)));
  }
}

}  // namespace

const char* cuda_unavailable_reason() {
  static const char* const reason = find_unavailable_reason();
  return reason;
}

void wait_for_device(Backend backend) {
  if (backend == Backend::cuda) {
    finish_launch("waiting for the GPU");
  }
}

long count_negative_cuda(const float* values, long count) {
  if (count <= 0) {
    return 0;
  }
  const DeviceScratch<unsigned long long> sum(1);
  check_cuda(cudaMemsetAsync(sum.data(), 0, sizeof(unsigned long long), current_stream()), "count_negative");
  constexpr int block = 256;
  const auto blocks = static_cast<unsigned>((count - 1) / block + 1);
  count_negative_values<<<blocks, block, 0, current_stream()>>>(values, count, sum.data());
  check_cuda(cudaGetLastError(), "count_negative");
  return static_cast<long>(read_cuda(sum.data(), "count_negative"));
}

void sum_counts_cuda(const std::int32_t* counts, int count, std::int32_t* sums) {
  const cudaStream_t stream = current_stream();
  check_cuda(cudaMemsetAsync(sums, 0, sizeof(std::int32_t), stream), "sum_counts");
  std::size_t bytes = 0;
  check_cuda(cub::DeviceScan::InclusiveSum(nullptr, bytes, counts, sums + 1, count, stream), "sum_counts");
  const DeviceScratch<char> room(bytes + 1);
  check_cuda(cub::DeviceScan::InclusiveSum(room.data(), bytes, counts, sums + 1, count, stream), "sum_counts");
  end_launch("sum_counts");
}

}  // namespace ergodome
