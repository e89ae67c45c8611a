#pragma once

#include <cstddef>
#include <cstdint>

#include "kernels/core/error.h"
#include "kernels/launch/kernel.h"

// The functions by which the rest of the program uses a GPU. In a program that is built without
// CUDA, kernels/launch/without_cuda.cpp defines them; those that need a GPU throw Error.
namespace ergodome {

//! Returns why CUDA cannot be used here, or nullptr if it can. For a driver error, the reason is
//! CUDA's description of it. The reason is determined at the first call.
const char* cuda_unavailable_reason();

//! Runs the kernel of a batch on the GPU. Defined where kernels are registered
//! (kernels/launch/register.h).
template <class Batch>
void launch_on_cuda(const Batch& batch);

//! Waits for everything that the calling thread has launched on the GPU, and throws Error if a
//! launch failed. Does nothing for Backend::cpu.
void wait_for_device(Backend backend);

//! Computes the exclusive prefix sums of `count` counts, followed by their total: `count` + 1
//! values. Both arrays are in the GPU's memory.
void sum_counts_cuda(const std::int32_t* counts, int count, std::int32_t* sums);

//! Returns how many of the values, which are in the GPU's memory, are below 0.
long count_negative_cuda(const float* values, long count);

//! Begin and end the scopes DeviceWorkInOrder and UrgentDeviceWork (render/backend/buffer.h).
//! `before` is what the function that began the scope returned.
bool begin_in_order_cuda();
void end_in_order_cuda(bool before, bool may_throw);
void* begin_urgent_cuda();
void end_urgent_cuda(void* before);

//! Allocate, release and fill GPU memory with 0, and copy between GPU and host memory.
void* allocate_cuda(std::size_t bytes);
void release_cuda(void* memory) noexcept;
void clear_cuda(void* memory, std::size_t bytes);
void copy_to_cuda(void* to, const void* from, std::size_t bytes);
void copy_from_cuda(void* to, const void* from, std::size_t bytes);

#if !defined(ERGODOME_HAVE_CUDA) && !defined(__CUDACC__)
//! Throws the Error of a program that was built without CUDA.
[[noreturn]] void refuse_cuda();

template <class Batch>
void launch_on_cuda(const Batch& /*batch*/) {
  refuse_cuda();
}
#endif

}  // namespace ergodome
