#pragma once

#include <atomic>
#include <cstdint>

#include "kernels/core/host_device.h"

namespace ergodome::inline ERGO_TARGET {

//! Increments a counter atomically and returns its previous value.
ERGO_HD std::int32_t count_up(std::int32_t* count) {
#if defined(__CUDA_ARCH__)
  return atomicAdd(count, 1);
#else
  return std::atomic_ref<std::int32_t>(*count).fetch_add(1, std::memory_order_relaxed);
#endif
}

}  // namespace ergodome::inline ERGO_TARGET
