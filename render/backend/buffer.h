#pragma once

#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <memory>
#include <new>
#include <string>
#include <vector>

#include "kernels/launch/launch.h"
#include "kernels/launch/launch_cuda.h"
#include "kernels/launch/work_counter.h"

namespace ergodome {

//! Copies `count` elements from where a backend keeps them to host memory.
template <class T>
void copy_to_host(Backend backend, T* to, const T* from, std::size_t count) {
  if (backend == Backend::cuda) {
    copy_from_cuda(to, from, count * sizeof(T));
  } else {
    std::copy(from, from + count, to);
  }
}

//! Owns an array where the kernels of a backend can reach it: host memory (64-byte aligned) or device memory.
template <class T>
class Buffer {
 public:
  Buffer() : data_(nullptr, Release{Backend::cpu}) {}

  //! `count` elements, not initialized; `name` is what their bytes are counted by ("buffer: NAME"). Throws Error where the device has no
  //! room, std::bad_alloc where the host has none.
  Buffer(Backend backend, std::size_t count, const char* name)
      : data_(static_cast<T*>(allocate(backend, count * sizeof(T))), Release{backend}), count_(count) {
    count_work(std::string("buffer: ") + name, static_cast<long>(count * sizeof(T)));
  }

  Buffer(Backend backend, const std::vector<T>& values, const char* name) : Buffer(backend, values.size(), name) {
    write(values.data(), values.size());
  }

  [[nodiscard]] T* data() const { return data_.get(); }
  [[nodiscard]] std::size_t size() const { return count_; }

  //! Fills the first `count` elements from host memory.
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

  //! Fills one element.
  void write_at(std::size_t place, T value) {
    if (data_.get_deleter().backend == Backend::cuda) {
      copy_to_cuda(data() + place, &value, sizeof(T));
    } else {
      data()[place] = value;
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
    void* memory = std::aligned_alloc(64, (bytes / 64 + 1) * 64);
    if (memory == nullptr) {
      throw std::bad_alloc();
    }
    return memory;
  }

  std::unique_ptr<T, Release> data_;
  std::size_t count_ = 0;
};

//! Makes room for `count` elements where there is not as much yet; what was there is gone then. What grows is given more than it asks for: the next
//! picture may want a little more.
template <class T>
void reserve(Backend backend, std::size_t count, const char* name, Buffer<T>& buffer) {
  if (buffer.size() < count) {
    buffer = Buffer<T>(backend, count + count / 4, name);
  }
}

//! Fills `count` elements with zero bytes, from `first` on.
template <class T>
void clear(Backend backend, const Buffer<T>& buffer, std::size_t count, std::size_t first = 0) {
  if (backend == Backend::cuda) {
    clear_cuda(buffer.data() + first, count * sizeof(T));
  } else {
    std::memset(buffer.data() + first, 0, count * sizeof(T));
  }
}

//! As long as it lives, the calling thread does not wait for what it asks of a device, which does it in order: for numbers that it reads it waits, and at the
//! end for all, unless one of these that was there before lives on. What other threads are to read must be waited for.
class DeviceWorkInOrder {
 public:
  explicit DeviceWorkInOrder(Backend backend) : in_order_(backend == Backend::cuda) {
    if (in_order_) {
      before_ = begin_in_order_cuda();
    }
  }
  //! Throws Error where something that was asked for failed; not where another error is on its way.
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

//! As long as it lives, what the calling thread asks of a device comes before what other threads have asked, and does not wait for that.
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
