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
  template <class U>
  struct rebind {  // NOLINT(readability-identifier-naming): the standard's name
    using other = UnfilledAllocator<U>;
  };

  UnfilledAllocator() = default;
  template <class U>
  UnfilledAllocator(const UnfilledAllocator<U>& /*other*/) noexcept {
  }  // NOLINT(google-explicit-constructor): as the standard asks

  //! Large pages where there are any: a page that is touched for the first time costs as much as some hundred of its pixels.
  [[nodiscard]] T* allocate(std::size_t count) {
    constexpr std::size_t page = std::size_t{1} << 21U;
    const std::size_t bytes = count * sizeof(T);
    if (bytes < 2 * page) {
      return std::allocator<T>::allocate(count);
    }
    void* const memory = std::aligned_alloc(page, (bytes / page + 1) * page);
    if (memory == nullptr) {
      throw std::bad_alloc();
    }
    static_cast<void>(madvise(memory, bytes, MADV_HUGEPAGE));
    return static_cast<T*>(memory);
  }
  void deallocate(T* memory, std::size_t count) noexcept {
    constexpr std::size_t page = std::size_t{1} << 21U;
    if (count * sizeof(T) < 2 * page) {
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
};

//! Numbers of a picture's pixels; resize() does not fill them.
using PixelValues = std::vector<float, UnfilledAllocator<float>>;

}  // namespace ergodome
