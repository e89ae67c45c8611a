#pragma once

#include <cstddef>
#include <cstdlib>
#include <memory>
#include <vector>

// Memory of large arrays on the CPU.

namespace ergodome {

//! Size from which an array is worth huge pages [bytes].
inline constexpr std::size_t min_large_bytes = std::size_t{1} << 22U;

//! Returns uninitialized memory for a large array, with huge pages if available: mapping small
//! pages may take longer than filling them. Release it with std::free(). Throws std::bad_alloc.
void* allocate_large(std::size_t bytes);

//! Allocator that gives arrays of at least min_large_bytes huge pages if available.
template <class T>
class LargeAllocator : public std::allocator<T> {
 public:
  LargeAllocator() = default;
  template <class U>
  // NOLINTNEXTLINE(google-explicit-constructor): as the standard asks
  LargeAllocator(const LargeAllocator<U>& /*other*/) noexcept {}

  [[nodiscard]] T* allocate(std::size_t count) {
    const std::size_t bytes = count * sizeof(T);
    return bytes < min_large_bytes ? std::allocator<T>::allocate(count) : static_cast<T*>(allocate_large(bytes));
  }

  void deallocate(T* memory, std::size_t count) noexcept {
    if (count * sizeof(T) < min_large_bytes) {
      return std::allocator<T>::deallocate(memory, count);
    }
    std::free(memory);
  }
};

//! A vector that may become large.
template <class T>
using LargeVector = std::vector<T, LargeAllocator<T>>;

}  // namespace ergodome
