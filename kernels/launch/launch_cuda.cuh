#pragma once

#include <cuda_runtime.h>

#include <string>

#include "kernels/core/error.h"

namespace ergodome {

//! Throws with CUDA's own name of a failure.
inline void check_cuda(cudaError_t code, const char* doing) {
  if (code != cudaSuccess) {
    throw Error("CUDA", std::string(doing) + " failed: " + cudaGetErrorString(code), "run with --backend cpu");
  }
}

template <class Functor>
__global__ void run_functor(Functor functor, int count) {
  const int index = static_cast<int>(blockIdx.x * blockDim.x + threadIdx.x);
  if (index < count) {
    functor(index);
  }
}

//! Calls functor(i) for i in [0, count) on the device and waits. The name goes into error messages.
template <class Functor>
void launch_cuda(const char* name, int count, const Functor& functor, cudaStream_t stream = nullptr) {
  constexpr int block = 128;
  if (count <= 0) {
    return;
  }
  run_functor<<<(count - 1) / block + 1, block, 0, stream>>>(functor, count);
  check_cuda(cudaGetLastError(), name);
  check_cuda(cudaStreamSynchronize(stream), name);
}

}  // namespace ergodome
