#include "kernels/launch/large_memory.h"

#include <sys/mman.h>

#include <new>

namespace ergodome {

void* allocate_large(std::size_t bytes) {
  constexpr std::size_t page_bytes = std::size_t{1} << 21U;
  const std::size_t whole = (bytes / page_bytes + 1) * page_bytes;
  void* const memory = std::aligned_alloc(page_bytes, whole);
  if (memory == nullptr) {
    throw std::bad_alloc();
  }
  static_cast<void>(madvise(memory, whole, MADV_HUGEPAGE));
  return memory;
}

}  // namespace ergodome
