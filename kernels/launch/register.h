#pragma once

#include <type_traits>

#include "kernels/core/host_device.h"
#include "kernels/launch/kernel.h"

#if defined(__CUDACC__)
#include "kernels/launch/launch_on_cuda.cuh"
#else
#include "kernels/core/arithmetic.h"
#include "kernels/core/pack.h"
#endif

// Registers kernels. A source *_kernels.cpp is compiled for each instruction set and, if a GPU runs
// its kernels, as CUDA. It contains only lines like these, in namespace ergodome:
//
//     ERGO_KERNEL(PixelBatch);                 for CPU and GPU
//     ERGO_CPU_KERNEL(NodeBatch<double>);      for the CPU alone
//
// kernels/CMakeLists.txt lists these sources.
#if defined(__CUDACC__)

#define ERGO_KERNEL(...) template void launch_on_cuda(const __VA_ARGS__&)
#define ERGO_CPU_KERNEL(...) static_assert(true)

#else

namespace ergodome::inline ERGO_TARGET {

//! The number type of a CPU kernel: a SIMD register if Kernel::wide, otherwise a single number.
template <class Batch>
using CpuLanes =
    std::conditional_t<Kernel<Batch>::wide, WidePack<typename Kernel<Batch>::Real>, typename Kernel<Batch>::Real>;

//! Runs calls [begin, end) of a batch's kernel.
template <class Batch>
void run_calls(const Batch& batch, int begin, int end) {
  using Lanes = CpuLanes<Batch>;
  dispatch<Lanes>(batch, [begin, end](const auto& functor) {
    for (int index = begin; index < end; ++index) {
      functor(index);
    }
  });
}

//! Returns the kernel of a batch as compiled for this instruction set.
template <class Batch>
CpuKernel<Batch> compiled_kernel() {
  using Lanes = CpuLanes<Batch>;
  constexpr int lanes = Kernel<Batch>::one_element_a_call ? 1 : RealTraits<Lanes>::lane_count;
  return {&run_calls<Batch>, lanes};
}

}  // namespace ergodome::inline ERGO_TARGET

#define ERGO_KERNEL(...) template CpuKernel<__VA_ARGS__> ERGO_TARGET::compiled_kernel<__VA_ARGS__>()
#define ERGO_CPU_KERNEL(...) ERGO_KERNEL(__VA_ARGS__)

#endif
