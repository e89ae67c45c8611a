#pragma once

#include <sys/mman.h>

#include <cstdlib>
#include <memory>
#include <new>
#include <utility>
#include <vector>

namespace ergodome {

//! Leaves what a vector is resized by as it lies in memory: whoever fills it touches it first, all threads at once.
template <class T>
class UnfilledAllocator : public std::allocator<T> {
 public:
  UnfilledAllocator() = default;
  template <class U>
  // NOLINTNEXTLINE(google-explicit-constructor): as the standard asks
  UnfilledAllocator(const UnfilledAllocator<U>& /*other*/) noexcept {}

  //! Large pages where there are any: a picture of both eyes took a twentieth of its time in being given small ones.
  [[nodiscard]] T* allocate(std::size_t count) {
    const std::size_t bytes = count * sizeof(T);
    if (bytes < least_large) {
      return std::allocator<T>::allocate(count);
    }
    void* const memory = std::aligned_alloc(large_page, (bytes / large_page + 1) * large_page);
    if (memory == nullptr) {
      throw std::bad_alloc();
    }
    static_cast<void>(madvise(memory, bytes, MADV_HUGEPAGE));
    return static_cast<T*>(memory);
  }

  void deallocate(T* memory, std::size_t count) noexcept {
    if (count * sizeof(T) < least_large) {
      return std::allocator<T>::deallocate(memory, count);
    }
    std::free(memory);
  }

  template <class U>
  void construct(U* at) noexcept {
    ::new (static_cast<void*>(at)) U;
  }
  template <class U, class... Values>
  void construct(U* at, Values&&... values) {
    ::new (static_cast<void*>(at)) U(std::forward<Values>(values)...);
  }

 private:
  static constexpr std::size_t large_page = std::size_t{1} << 21U;
  static constexpr std::size_t least_large = 2 * large_page;
};

// Kernels write a pixel at a time.
static_assert(__STDCPP_DEFAULT_NEW_ALIGNMENT__ >= 4 * sizeof(float));

//! Numbers of a picture's pixels; resize() does not fill them.
using PixelValues = std::vector<float, UnfilledAllocator<float>>;

}  // namespace ergodome
