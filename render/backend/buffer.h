#pragma once

#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <memory>
#include <new>
#include <string>
#include <vector>

#include "kernels/launch/cuda.h"
#include "kernels/launch/large_memory.h"
#include "kernels/launch/launch.h"
#include "kernels/launch/work_counter.h"

// Arrays in a backend's memory, and the order of GPU work.

namespace ergodome {

//! Copies `count` elements from a backend's memory to host memory.
template <class T>
void copy_to_host(Backend backend, T* to, const T* from, std::size_t count) {
  if (backend == Backend::cuda) {
    copy_from_cuda(to, from, count * sizeof(T));
  } else {
    std::copy(from, from + count, to);
  }
}

//! Owns an array that a backend's kernels can access: host memory (64-byte aligned) or GPU memory.
template <class T>
class Buffer {
 public:
  Buffer() : data_(nullptr, Release{Backend::cpu}) {}

  //! Allocates `count` uninitialized elements. Statistics count their bytes under "buffer: NAME".
  //! Throws Error if the GPU is out of memory, std::bad_alloc if the host is.
  Buffer(Backend backend, std::size_t count, const char* name)
      : data_(static_cast<T*>(allocate(backend, count * sizeof(T))), Release{backend}), count_(count) {
    count_work(std::string("buffer: ") + name, static_cast<long>(count * sizeof(T)));
  }

  Buffer(Backend backend, const std::vector<T>& values, const char* name) : Buffer(backend, values.size(), name) {
    write(values.data(), values.size());
  }

  [[nodiscard]] T* data() const { return data_.get(); }
  [[nodiscard]] std::size_t size() const { return count_; }

  //! Copies the first `count` elements from host memory.
  void write(const T* from, std::size_t count) {
    if (count == 0) {
      return;
    }
    if (data_.get_deleter().backend == Backend::cuda) {
      copy_to_cuda(data(), from, count * sizeof(T));
    } else {
      std::copy(from, from + count, data());
    }
  }

  //! Sets one element.
  void write_at(std::size_t position, T value) {
    if (data_.get_deleter().backend == Backend::cuda) {
      copy_to_cuda(data() + position, &value, sizeof(T));
    } else {
      data()[position] = value;
    }
  }

  //! Copies the first `count` elements to host memory.
  void read(T* to, std::size_t count) const {
    if (count > 0) {
      copy_to_host(data_.get_deleter().backend, to, data(), count);
    }
  }

 private:
  struct Release {
    Backend backend;
    void operator()(T* memory) const noexcept {
      if (backend == Backend::cuda) {
        release_cuda(memory);
      } else {
        std::free(memory);
      }
    }
  };

  static void* allocate(Backend backend, std::size_t bytes) {
    if (backend == Backend::cuda) {
      return allocate_cuda(std::max<std::size_t>(bytes, 1));
    }
    void* memory = bytes < min_large_bytes ? std::aligned_alloc(64, (bytes / 64 + 1) * 64) : allocate_large(bytes);
    if (memory == nullptr) {
      throw std::bad_alloc();
    }
    return memory;
  }

  std::unique_ptr<T, Release> data_;
  std::size_t count_ = 0;
};

//! Grows a buffer to at least `count` elements; discards the contents if it grows. Allocates a
//! quarter more than needed, as the next picture may need slightly more.
template <class T>
void reserve(Backend backend, std::size_t count, const char* name, Buffer<T>& buffer) {
  if (buffer.size() < count) {
    buffer = Buffer<T>(backend, count + count / 4, name);
  }
}

//! Fills `count` elements with zero bytes, starting at `first`.
template <class T>
void clear(Backend backend, const Buffer<T>& buffer, std::size_t count, std::size_t first = 0) {
  if (backend == Backend::cuda) {
    clear_cuda(buffer.data() + first, count * sizeof(T));
  } else {
    std::memset(buffer.data() + first, 0, count * sizeof(T));
  }
}

//! While it exists, GPU work of the calling thread is queued in order and the thread does not wait
//! for it. The thread waits when it reads results and when the outermost of these objects is
//! destroyed. Wait explicitly before other threads read results.
class DeviceWorkInOrder {
 public:
  explicit DeviceWorkInOrder(Backend backend) : in_order_(backend == Backend::cuda) {
    if (in_order_) {
      before_ = begin_in_order_cuda();
    }
  }
  //! Throws Error if queued work failed, unless another exception is in flight.
  ~DeviceWorkInOrder() noexcept(false) {
    if (in_order_) {
      end_in_order_cuda(before_, std::uncaught_exceptions() == errors_);
    }
  }
  DeviceWorkInOrder(const DeviceWorkInOrder&) = delete;
  DeviceWorkInOrder& operator=(const DeviceWorkInOrder&) = delete;

 private:
  bool in_order_;
  bool before_ = false;
  int errors_ = std::uncaught_exceptions();
};

//! While it exists, GPU work of the calling thread goes into a separate CUDA stream of the highest
//! priority: this work is preferred to that of other threads and does not wait for theirs.
class UrgentDeviceWork {
 public:
  explicit UrgentDeviceWork(Backend backend) : urgent_(backend == Backend::cuda) {
    if (urgent_) {
      before_ = begin_urgent_cuda();
    }
  }
  ~UrgentDeviceWork() {
    if (urgent_) {
      end_urgent_cuda(before_);
    }
  }
  UrgentDeviceWork(const UrgentDeviceWork&) = delete;
  UrgentDeviceWork& operator=(const UrgentDeviceWork&) = delete;

 private:
  bool urgent_;
  void* before_ = nullptr;
};

}  // namespace ergodome
