#pragma once

#include <cstddef>
#include <memory>
#include <utility>
#include <vector>

#include "kernels/launch/large_memory.h"

namespace ergodome {

//! Makes the process keep freed memory for later allocations: successive pictures need the same
//! amount, and mapping new pages may take longer than filling them. Call once, at startup.
void keep_freed_memory();

//! Returns uninitialized memory for a large array: a kept block of the same size
//! (return_large_block()), or new memory, with huge pages if available. Throws std::bad_alloc.
void* take_large_block(std::size_t bytes);

//! Keeps memory from take_large_block() for a later request of the same number of 2 MiB pages. If
//! more than four blocks or 1.5 GiB are then kept, frees those that were returned first.
void return_large_block(void* memory, std::size_t bytes) noexcept;

//! Returns the number of released blocks that are kept for later requests.
std::size_t cached_large_blocks();

//! Allocator that leaves the elements added by resize() uninitialized, so that all threads touch
//! the pages first while they fill them.
template <class T>
class UnfilledAllocator : public std::allocator<T> {
 public:
  UnfilledAllocator() = default;
  template <class U>
  // NOLINTNEXTLINE(google-explicit-constructor): as the standard asks
  UnfilledAllocator(const UnfilledAllocator<U>& /*other*/) noexcept {}

  //! Takes 4 MiB or more from take_large_block(), which reuses the memory of the last picture or
  //! uses huge pages if available: mapping small pages took a twentieth of the time of two eyes'
  //! pictures.
  [[nodiscard]] T* allocate(std::size_t count) {
    const std::size_t bytes = count * sizeof(T);
    if (bytes < min_large_bytes) {
      return std::allocator<T>::allocate(count);
    }
    return static_cast<T*>(take_large_block(bytes));
  }

  void deallocate(T* memory, std::size_t count) noexcept {
    if (count * sizeof(T) < min_large_bytes) {
      return std::allocator<T>::deallocate(memory, count);
    }
    return_large_block(memory, count * sizeof(T));
  }

  template <class U>
  void construct(U* at) noexcept {
    ::new (static_cast<void*>(at)) U;
  }
  template <class U, class... Values>
  void construct(U* at, Values&&... values) {
    ::new (static_cast<void*>(at)) U(std::forward<Values>(values)...);
  }
};

// Smaller arrays have only the default alignment, and kernels write the four floats of a pixel at
// once.
static_assert(__STDCPP_DEFAULT_NEW_ALIGNMENT__ >= 4 * sizeof(float));

//! Values of a picture's pixels; resize() does not initialize them.
using PixelValues = std::vector<float, UnfilledAllocator<float>>;

}  // namespace ergodome

// Instantiated only in cached_memory.cpp, which is compiled with optimization. Unoptimized copies destroy the values one by
// one, which took 1.5 ms a picture.
// NOLINTNEXTLINE(bugprone-std-namespace-modification): the standard allows this for a type of one's own
extern template class std::vector<float, ergodome::UnfilledAllocator<float>>;
