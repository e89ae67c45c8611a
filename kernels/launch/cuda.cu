#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cub/device/device_scan.cuh>
#include <memory>
#include <mutex>
#include <utility>
#include <vector>

#include "kernels/launch/launch_on_cuda.cuh"
#include "kernels/launch/parallel_for.h"

// Finds the GPU, waits for it, allocates its memory, copies between it and the host, and reduces
// arrays in it.
namespace ergodome {

namespace {

const char* find_unavailable_reason() {
  // Checks for a driver first, because without one the runtime reports an insufficient driver. The
  // driver version is then 0.
  int driver_version = 0;
  if (cudaDriverGetVersion(&driver_version) == cudaSuccess && driver_version == 0) {
    return "no NVIDIA driver is installed";
  }
  int count = 0;
  const cudaError_t code = cudaGetDeviceCount(&count);
  if (code == cudaErrorInsufficientDriver) {
    return "the NVIDIA driver is too old for the CUDA version that this program was built with; update it";
  }
  if (code != cudaSuccess && code != cudaErrorNoDevice) {
    return cudaGetErrorString(code);
  }
  return count > 0 ? nullptr : "no NVIDIA GPU was found";
}

__global__ void count_negative_values(const float* values, long count, unsigned long long* sum) {
  const long at = static_cast<long>(blockIdx.x) * blockDim.x + threadIdx.x;
  const unsigned found = __ballot_sync(0xffffffffU, at < count && values[at] < 0.0F);
  if (threadIdx.x % 32 == 0 && found != 0U) {
    atomicAdd(sum, static_cast<unsigned long long>(__popc(found)));
  }
}

}  // namespace

const char* cuda_unavailable_reason() {
  static const char* const reason = find_unavailable_reason();
  return reason;
}

void wait_for_device(Backend backend) {
  if (backend == Backend::cuda) {
    finish_launch("waiting for the GPU");
  }
}

long count_negative_cuda(const float* values, long count) {
  if (count <= 0) {
    return 0;
  }
  const DeviceScratch<unsigned long long> sum(1);
  check_cuda(cudaMemsetAsync(sum.data(), 0, sizeof(unsigned long long), current_stream()), "count_negative");
  constexpr int block = 256;
  const auto blocks = static_cast<unsigned>((count - 1) / block + 1);
  count_negative_values<<<blocks, block, 0, current_stream()>>>(values, count, sum.data());
  check_cuda(cudaGetLastError(), "count_negative");
  return static_cast<long>(read_cuda(sum.data(), "count_negative"));
}

void sum_counts_cuda(const std::int32_t* counts, int count, std::int32_t* sums) {
  const cudaStream_t stream = current_stream();
  check_cuda(cudaMemsetAsync(sums, 0, sizeof(std::int32_t), stream), "sum_counts");
  std::size_t bytes = 0;
  check_cuda(cub::DeviceScan::InclusiveSum(nullptr, bytes, counts, sums + 1, count, stream), "sum_counts");
  const DeviceScratch<char> room(bytes + 1);
  check_cuda(cub::DeviceScan::InclusiveSum(room.data(), bytes, counts, sums + 1, count, stream), "sum_counts");
  end_launch("sum_counts");
}

namespace {

//! Returns the memory pool that keeps released GPU memory in the process, because allocating from
//! the driver for each picture takes longer than many kernels. Returns null if the device has no
//! pools.
cudaMemPool_t kept_pool() {
  static const cudaMemPool_t pool = [] {
    int device = 0;
    check_cuda(cudaGetDevice(&device), "finding the GPU");
    int has_pools = 0;
    check_cuda(cudaDeviceGetAttribute(&has_pools, cudaDevAttrMemoryPoolsSupported, device), "querying the GPU");
    cudaMemPool_t found = nullptr;
    if (has_pools == 0) {
      return found;
    }
    check_cuda(cudaDeviceGetDefaultMemPool(&found, device), "finding the GPU memory pool");
    // Limits the memory that the pool keeps, because other programs and OpenGL need device memory,
    // too.
    std::uint64_t max_bytes = std::uint64_t{1} << 30;
    check_cuda(cudaMemPoolSetAttribute(found, cudaMemPoolAttrReleaseThreshold, &max_bytes),
               "setting up the GPU memory pool");
    return found;
  }();
  return pool;
}

}  // namespace

void* allocate_cuda(std::size_t bytes) {
  void* memory = nullptr;
  if (kept_pool() == nullptr) {
    check_cuda(cudaMalloc(&memory, bytes), "allocating GPU memory");
    return memory;
  }
  check_cuda(cudaMallocFromPoolAsync(&memory, bytes, kept_pool(), current_stream()), "allocating GPU memory");
  // Other streams may copy into the new memory, so the allocation must have finished. Threads that
  // work in order use one stream and need not wait.
  if (!works_in_order()) {
    check_cuda(cudaStreamSynchronize(current_stream()), "allocating GPU memory");
  }
  return memory;
}

void release_cuda(void* memory) noexcept {
  if (kept_pool() == nullptr) {
    cudaFree(memory);
  } else {
    cudaFreeAsync(memory, current_stream());
  }
  cudaGetLastError();
}

namespace {

//! A separate CUDA stream, so that copies and the pictures in flight do not wait for each other.
class CopyStream {
 public:
  CopyStream() { check_cuda(cudaStreamCreateWithFlags(&handle_, cudaStreamNonBlocking), "creating a CUDA stream"); }
  ~CopyStream() { cudaStreamDestroy(handle_); }
  CopyStream(const CopyStream&) = delete;
  CopyStream& operator=(const CopyStream&) = delete;

  [[nodiscard]] cudaStream_t handle() const { return handle_; }

 private:
  cudaStream_t handle_ = nullptr;
};

//! Pinned memory through which pictures are copied to ordinary memory in parts: while the device
//! writes one part, the threads copy the one before. The driver's own method uses one thread.
class HostStage {
 public:
  static constexpr std::size_t bytes = std::size_t{4} << 20;

  void copy(std::byte* to, const std::byte* from, std::size_t count) {
    const std::size_t parts = (count - 1) / bytes + 1;
    const auto size_of = [&](std::size_t part) { return std::min(bytes, count - part * bytes); };
    const auto send = [&](std::size_t part) {
      const Half& half = halves_[part % 2];
      check_cuda(
          cudaMemcpyAsync(half.memory, from + part * bytes, size_of(part), cudaMemcpyDeviceToHost, stream_.handle()),
          "copying from the GPU");
      check_cuda(cudaEventRecord(half.there, stream_.handle()), "copying from the GPU");
    };
    send(0);
    for (std::size_t part = 0; part < parts; ++part) {
      if (part + 1 < parts) {
        send(part + 1);
      }
      const Half& half = halves_[part % 2];
      check_cuda(cudaEventSynchronize(half.there), "copying from the GPU");
      constexpr int piece = 1 << 18;
      parallel_for(static_cast<int>(size_of(part)), piece, [&](int begin, int end) {
        std::copy(half.memory + begin, half.memory + end, to + part * bytes + begin);
      });
    }
  }

 private:
  struct Half {
    Half() {
      check_cuda(cudaEventCreateWithFlags(&there, cudaEventDisableTiming), "creating a CUDA event");
      check_cuda(cudaMallocHost(&memory, bytes), "allocating pinned memory");
    }
    std::byte* memory = nullptr;
    cudaEvent_t there = nullptr;
  };
  CopyStream stream_;
  Half halves_[2];
};

//! Objects kept for reuse, because making one takes longer than most uses of it. They are never
//! destroyed, because at the end of the process the driver may be gone before them.
template <class T>
class ReusePool {
 public:
  //! Takes one of the objects for exclusive use, and gives it back in the destructor.
  class Taken {
   public:
    Taken() : thing_(instance().take()) {}
    ~Taken() { instance().give_back(std::move(thing_)); }
    Taken(const Taken&) = delete;
    Taken& operator=(const Taken&) = delete;
    T* operator->() const { return thing_.get(); }

   private:
    static ReusePool& instance() {
      static ReusePool& all = *new ReusePool;
      return all;
    }
    std::unique_ptr<T> thing_;
  };

 private:
  std::unique_ptr<T> take() {
    const std::lock_guard lock(mutex_);
    if (things_.empty()) {
      return std::make_unique<T>();
    }
    std::unique_ptr<T> last = std::move(things_.back());
    things_.pop_back();
    return last;
  }

  void give_back(std::unique_ptr<T> thing) noexcept {
    const std::lock_guard lock(mutex_);
    things_.push_back(std::move(thing));
  }

  std::mutex mutex_;
  std::vector<std::unique_ptr<T>> things_;
};

}  // namespace

void clear_cuda(void* memory, std::size_t bytes) {
  check_cuda(cudaMemsetAsync(memory, 0, bytes, current_stream()), "clearing GPU memory");
}

void copy_to_cuda(void* to, const void* from, std::size_t bytes) {
  if (works_in_order()) {
    // The driver may read the source after the call returns, when the caller may already have freed
    // it.
    check_cuda(cudaMemcpyAsync(to, from, bytes, cudaMemcpyHostToDevice, current_stream()), "copying to the GPU");
    return finish_launch("copying to the GPU");
  }
  const ReusePool<CopyStream>::Taken stream;
  check_cuda(cudaMemcpyAsync(to, from, bytes, cudaMemcpyHostToDevice, stream->handle()), "copying to the GPU");
  check_cuda(cudaStreamSynchronize(stream->handle()), "copying to the GPU");
}

void copy_from_cuda(void* to, const void* from, std::size_t bytes) {
  constexpr std::size_t few_bytes = std::size_t{256} << 10;
  if (bytes < few_bytes) {
    check_cuda(cudaMemcpyAsync(to, from, bytes, cudaMemcpyDeviceToHost, current_stream()), "copying from the GPU");
    check_cuda(cudaStreamSynchronize(current_stream()), "copying from the GPU");
    return;
  }
  if (works_in_order()) {
    finish_launch("copying from the GPU");
  }
  const ReusePool<HostStage>::Taken stage;
  stage->copy(static_cast<std::byte*>(to), static_cast<const std::byte*>(from), bytes);
}

void* begin_urgent_cuda() {
  static const cudaStream_t urgent = [] {
    int minimum = 0;
    int maximum = 0;
    check_cuda(cudaDeviceGetStreamPriorityRange(&minimum, &maximum), "querying the GPU");
    cudaStream_t stream = nullptr;
    check_cuda(cudaStreamCreateWithPriority(&stream, cudaStreamNonBlocking, maximum), "creating a CUDA stream");
    return stream;
  }();
  return std::exchange(current_stream(), urgent);
}

bool begin_in_order_cuda() { return std::exchange(works_in_order(), true); }

void end_in_order_cuda(bool before, bool may_throw) {
  works_in_order() = before;
  if (before) {
    return;
  }
  if (may_throw) {
    return finish_launch("waiting for the GPU");
  }
  cudaStreamSynchronize(current_stream());
  cudaGetLastError();
}

void end_urgent_cuda(void* before) { current_stream() = static_cast<cudaStream_t>(before); }

}  // namespace ergodome
