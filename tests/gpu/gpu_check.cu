// Runs kernels on GPU and CPU, compares the results and measures the times. Exit status: 0 if they
// agree or there is no GPU, 1 if they differ or CUDA reports an error.

#include <cstdio>
#include <exception>

#include "tests/gpu/harness.cuh"

namespace {

void print_device(int device) {
  cudaDeviceProp properties{};
  ergodome::check_cuda(cudaGetDeviceProperties(&properties, device), "read the device's properties");
  std::printf("GPU check on %s: compute capability %d.%d, %d multiprocessors, %.1f GiB\n", properties.name,
              properties.major, properties.minor, properties.multiProcessorCount,
              static_cast<double>(properties.totalGlobalMem) / (1024.0 * 1024.0 * 1024.0));
  std::printf("%-34s %10s %10s %10s %9s %12s\n", "kernel", "elements", "GPU ms", "CPU ms", "ratio", "difference");
}

}  // namespace

int main() {
  int devices = 0;
  // Any error means that there is no usable GPU; `devices` is undefined then.
  if (cudaGetDeviceCount(&devices) != cudaSuccess || devices < 1) {
    std::puts("GPU check skipped: no usable GPU");
    return 0;
  }
  try {
    print_device(0);
    const bool rays = ergodome::gpu_check::check_rays();
    const bool pixels = ergodome::gpu_check::check_pixels();
    const bool grids = ergodome::gpu_check::check_grids();
    const bool projections = ergodome::gpu_check::check_projections();
    return rays && pixels && grids && projections ? 0 : 1;
  } catch (const std::exception& problem) {
    std::printf("GPU check: %s\n", problem.what());
    return 1;
  }
}
