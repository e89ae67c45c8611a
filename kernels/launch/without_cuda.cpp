#include "kernels/launch/cuda.h"

namespace ergodome {

void refuse_cuda() { throw Error("CUDA", "this program was built without CUDA", "run with --backend cpu"); }

const char* cuda_unavailable_reason() { return "this program was built without CUDA"; }

void wait_for_device(Backend backend) {
  if (backend == Backend::cuda) {
    refuse_cuda();
  }
}

void sum_counts_cuda(const std::int32_t*, int, std::int32_t*) { refuse_cuda(); }

long count_negative_cuda(const float*, long) { refuse_cuda(); }

bool begin_in_order_cuda() { refuse_cuda(); }

void end_in_order_cuda(bool, bool) {}

void* begin_urgent_cuda() { refuse_cuda(); }

void end_urgent_cuda(void*) {}

void* allocate_cuda(std::size_t) { refuse_cuda(); }

void release_cuda(void*) noexcept {}

void clear_cuda(void*, std::size_t) { refuse_cuda(); }

void copy_to_cuda(void*, const void*, std::size_t) { refuse_cuda(); }

void copy_from_cuda(void*, const void*, std::size_t) { refuse_cuda(); }

}  // namespace ergodome
