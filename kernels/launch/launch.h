#pragma once

#include <cstdint>
#include <numeric>

#include "kernels/launch/check_numbers.h"
#include "kernels/launch/cuda.h"
#include "kernels/launch/instruction_set.h"
#include "kernels/launch/kernel.h"
#include "kernels/launch/parallel_for.h"
#include "kernels/launch/work_counter.h"

// Launches kernels, on the CPU or on a GPU.
namespace ergodome {

// These functions are defined by the registrations of kernels (kernels/launch/register.h).
inline namespace portable {
template <class Batch>
CpuKernel<Batch> compiled_kernel();
}
namespace avx2 {
template <class Batch>
CpuKernel<Batch> compiled_kernel();
}
namespace avx512 {
template <class Batch>
CpuKernel<Batch> compiled_kernel();
}

//! Returns the kernel of a batch for an instruction set, for which has_instruction_set() must be
//! true.
template <class Batch>
CpuKernel<Batch> cpu_kernel(InstructionSet set) {
  if constexpr (Kernel<Batch>::compiled_once) {
    return portable::compiled_kernel<Batch>();
  } else {
    switch (set) {
      case InstructionSet::avx512:
#if defined(ERGODOME_SIMD_AVX512)
        return avx512::compiled_kernel<Batch>();
#endif
      case InstructionSet::avx2:
#if defined(ERGODOME_SIMD_AVX2)
        return avx2::compiled_kernel<Batch>();
#endif
      case InstructionSet::portable:
#if defined(ERGODOME_SIMD_PORTABLE)
        return portable::compiled_kernel<Batch>();
#endif
        break;
    }
    throw missing_instruction_set();
  }
}

//! Runs the kernel of a batch on all CPU threads.
template <class Batch>
void launch_on_cpu(const Batch& batch) {
  const CpuKernel<Batch> kernel = cpu_kernel<Batch>(active_instruction_set());
  parallel_for(kernel.calls(batch), Kernel<Batch>::grain, [&](int begin, int end) { kernel.run(batch, begin, end); });
}

//! Runs the kernel of a batch on the CPU, in host memory, on the calling thread. Does not count it.
template <class Batch>
void run_on_this_thread(const Batch& batch) {
  const CpuKernel<Batch> kernel = cpu_kernel<Batch>(active_instruction_set());
  kernel.run(batch, 0, kernel.calls(batch));
}

//! Counts a launch of a batch, calls run(), and checks that the outputs are finite if
//! numbers_are_checked(). Does none of this if the kernel's name is nullptr.
template <class Batch, class Run>
void count_and_check(Backend backend, const Batch& batch, const Run& run) {
  const char* const name = Kernel<Batch>::name(batch);
  if (name == nullptr) {
    return;
  }
  if constexpr (Kernel<Batch>::counted) {
    WorkCounter& counter = work_counter(name);
    const long elements = counted_elements(batch);
    for (int more = 1; more < Kernel<Batch>::counted_launches; ++more) {
      counter.count(elements);
    }
    const WorkScope work(counter, elements);
    run();
  } else {
    run();
  }
  if (numbers_are_checked()) {
    Kernel<Batch>::visit_outputs(batch, OutputCheck{name, backend});
  }
}

//! Runs the kernel of a batch, whose arrays are in the backend's memory. With Backend::cuda,
//! returns after the device has finished. Two exceptions need wait_for_device(): threads that work
//! in order (DeviceWorkInOrder), and the kernels of kernels/image/warp_pixels.cu.
//!
//! Throws Error if a launch fails, or if numbers_are_checked() and an output is not finite.
template <class Batch>
void launch(Backend backend, const Batch& batch) {
  count_and_check(backend, batch, [&] {
    if (backend == Backend::cuda) {
      launch_on_cuda(batch);
    } else {
      launch_on_cpu(batch);
    }
  });
}

//! Runs a kernel that exists for the CPU only.
template <class Batch>
void launch(const Batch& batch) {
  count_and_check(Backend::cpu, batch, [&] { launch_on_cpu(batch); });
}

//! Computes the exclusive prefix sums of `count` counts, followed by their total: `count` + 1
//! values. Both arrays are in the backend's memory.
inline void sum_counts(Backend backend, const std::int32_t* counts, int count, std::int32_t* sums) {
  if (backend == Backend::cuda) {
    return sum_counts_cuda(counts, count, sums);
  }
  sums[0] = 0;
  std::partial_sum(counts, counts + count, sums + 1);
}

}  // namespace ergodome
