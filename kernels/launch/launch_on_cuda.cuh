#pragma once

#include <cuda_runtime.h>

#include <string>

#include "kernels/core/error.h"
#include "kernels/launch/cuda.h"

// Helpers that launch functors on the GPU.
namespace ergodome {

//! Throws Error with CUDA's description of a failure.
inline void check_cuda(cudaError_t code, const char* doing) {
  if (code != cudaSuccess) {
    // Clears the error; otherwise the next launch would fail with it.
    cudaGetLastError();
    throw Error("CUDA", std::string(doing) + " failed: " + cudaGetErrorString(code), "run with --backend cpu");
  }
}

template <class Functor>
__global__ void run_functor(Functor functor, int count) {
  const int index = static_cast<int>(blockIdx.x * blockDim.x + threadIdx.x);
  if (index < count) {
    functor(index);
  }
}

//! Returns the stream for the calling thread's work: the default stream, or another during
//! UrgentDeviceWork.
inline cudaStream_t& current_stream() {
  thread_local cudaStream_t stream = nullptr;
  return stream;
}

//! Returns whether launches of the calling thread do not wait: during DeviceWorkInOrder.
inline bool& works_in_order() {
  thread_local bool in_order = false;
  return in_order;
}

//! Waits for the end of all launches of the calling thread.
inline void finish_launch(const char* name) {
  const cudaError_t launched = cudaGetLastError();
  check_cuda(cudaStreamSynchronize(current_stream()), name);
  check_cuda(launched, name);
}

//! Ends a launch: waits for it, unless works_in_order().
inline void end_launch(const char* name) {
  if (works_in_order()) {
    check_cuda(cudaGetLastError(), name);
  } else {
    finish_launch(name);
  }
}

//! Calls functor(i) for i in [0, count) on the device, after earlier launches, and does not wait
//! (finish_launch() does). The name is used in error messages.
template <class Functor>
void enqueue_cuda(const char* name, int count, const Functor& functor) {
  constexpr int block = 128;
  if (count <= 0) {
    return;
  }
  run_functor<<<(count - 1) / block + 1, block, 0, current_stream()>>>(functor, count);
  check_cuda(cudaGetLastError(), name);
}

//! Calls functor(i) for i in [0, count) on the device, and waits unless works_in_order().
template <class Functor>
void launch_cuda(const char* name, int count, const Functor& functor) {
  if (count > 0) {
    enqueue_cuda(name, count, functor);
    end_launch(name);
  }
}

//! Copies a value from the device after the work in the current stream.
template <class T>
T read_cuda(const T* from, const char* name) {
  T value{};
  check_cuda(cudaMemcpyAsync(&value, from, sizeof(T), cudaMemcpyDeviceToHost, current_stream()), name);
  check_cuda(cudaStreamSynchronize(current_stream()), name);
  return value;
}

//! Threads of a block of pixels: 16 x 8, and 8 x 4 per warp. Threads of a warp have adjacent
//! pixels, whose rays take about the same number of steps.
inline constexpr int pixel_block = 128;

inline dim3 blocks_of_pixels(int width, int rows) {
  return {static_cast<unsigned>((width - 1) / 16 + 1), static_cast<unsigned>((rows - 1) / 8 + 1)};
}

//! The pixel of a thread in such blocks; it may be outside the picture.
struct PixelOfThread {
  int x;
  int y;

  __device__ PixelOfThread(const uint3& block, const uint3& thread)
      : x(static_cast<int>(block.x * 16 + thread.x / 32 % 2 * 8 + thread.x % 8)),
        y(static_cast<int>(block.y * 8 + thread.x / 64 * 4 + thread.x % 32 / 8)) {}
};

//! Calls functor(y * width + x) for the pixels of a block of rows.
template <class Functor>
__global__ void run_functor_on_pixels(Functor functor, int width, int rows) {
  const PixelOfThread at(blockIdx, threadIdx);
  if (at.x < width && at.y < rows) {
    functor(at.y * width + at.x);
  }
}

template <class Functor>
void launch_cuda_on_pixels(const char* name, int width, int rows, const Functor& functor) {
  if (width <= 0 || rows <= 0) {
    return;
  }
  run_functor_on_pixels<<<blocks_of_pixels(width, rows), pixel_block, 0, current_stream()>>>(functor, width, rows);
  end_launch(name);
}

//! Device memory for the duration of a launch.
template <class T>
class DeviceScratch {
 public:
  explicit DeviceScratch(std::size_t count) : data_(static_cast<T*>(allocate_cuda(count * sizeof(T)))) {}
  ~DeviceScratch() { release_cuda(data_); }
  DeviceScratch(const DeviceScratch&) = delete;
  DeviceScratch& operator=(const DeviceScratch&) = delete;

  [[nodiscard]] T* data() const { return data_; }

 private:
  T* data_;
};

//! Runs a functor on the elements of a batch.
template <class Batch, class Functor>
void launch_functor(const Batch& batch, const Functor& functor) {
  const char* const name = Kernel<Batch>::name(batch);
  if constexpr (requires { Kernel<Batch>::rows(batch); }) {
    const PixelRows rows = Kernel<Batch>::rows(batch);
    launch_cuda_on_pixels(name, rows.width_px, rows.count, functor);
  } else {
    launch_cuda(name, Kernel<Batch>::elements(batch), functor);
  }
}

//! Runs the kernel of a batch on the device.
template <class Batch>
void launch_on_cuda(const Batch& batch) {
  dispatch<typename Kernel<Batch>::Real>(batch, [&](const auto& functor) { launch_functor(batch, functor); });
}

//! Runs the first step of pixels, and lists those for which it returns that there is more to do.
template <class Step>
__global__ void list_unfinished(Step step, int width, int rows, int* listed, int* count) {
  const PixelOfThread at(blockIdx, threadIdx);
  if (at.x < width && at.y < rows && step(at.y * width + at.x)) {
    listed[atomicAdd(count, 1)] = at.y * width + at.x;
  }
}

//! Runs a functor on the listed pixels. Threads take them in turns, because only the device knows
//! their number.
template <class Functor>
__global__ void run_functor_on_listed(Functor functor, const int* listed, const int* count) {
  const int threads = static_cast<int>(gridDim.x * blockDim.x);
  for (int at = static_cast<int>(blockIdx.x * blockDim.x + threadIdx.x); at < *count; at += threads) {
    functor(listed[at]);
  }
}

//! Draws pixels of which few are expensive, so that the threads of the others do not wait for them.
//! step(index) does the work that all pixels need and returns whether there is more to do;
//! rest(list, count), both in device memory, does this in separate launches.
template <class Step, class Rest>
void launch_cuda_in_steps(const char* name, int width, int rows, const Step& step, const Rest& rest) {
  if (width <= 0 || rows <= 0) {
    return;
  }
  const DeviceScratch<int> memory(static_cast<std::size_t>(width) * static_cast<std::size_t>(rows) + 1);
  int* const listed = memory.data() + 1;
  check_cuda(cudaMemsetAsync(memory.data(), 0, sizeof(int), current_stream()), name);
  list_unfinished<<<blocks_of_pixels(width, rows), pixel_block, 0, current_stream()>>>(step, width, rows, listed,
                                                                                       memory.data());
  check_cuda(cudaGetLastError(), name);
  rest(listed, static_cast<const int*>(memory.data()));
  end_launch(name);
}

}  // namespace ergodome
