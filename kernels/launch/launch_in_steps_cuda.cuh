#pragma once

#include "kernels/launch/launch_cuda.cuh"
#include "kernels/near_rays/pixel_samples.h"

// Launches in two steps, for pixels of which only a few are expensive.
namespace ergodome {

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

//! Draws one sample per thread. The samples of a pixel are on adjacent threads, because their rays
//! are similar.
template <class Functor>
__global__ void draw_samples(Functor functor, const int* fine, int count) {
  constexpr int samples = near_samples * near_samples;
  static_assert(samples <= 32 && 32 % samples == 0);
  const auto thread = static_cast<long>(blockIdx.x) * blockDim.x + threadIdx.x;
  const long pixel = thread / samples;
  const bool wanted = pixel < count;
  SeenLanes<float> sum = {0.0F, 0.0F, 0.0F, 0.0F};
  if (wanted) {
    sum = functor.see_sample(fine[pixel], static_cast<int>(thread % samples));
  }
  for (int apart = samples / 2; apart > 0; apart /= 2) {
    sum.red += __shfl_xor_sync(0xffffffffU, sum.red, apart);
    sum.green += __shfl_xor_sync(0xffffffffU, sum.green, apart);
    sum.blue += __shfl_xor_sync(0xffffffffU, sum.blue, apart);
    sum.clear += __shfl_xor_sync(0xffffffffU, sum.clear, apart);
  }
  if (wanted && thread % samples == 0) {
    functor.lay_mean(fine[pixel], sum);
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

//! First step of DrawNearField and DrawFlatEyes.
template <class Functor>
struct DrawMiddle {
  Functor functor;
  __device__ bool operator()(int index) const { return functor.draw_middle(index); }
};

//! Draws pixels of which few need many samples.
template <class Functor>
void launch_cuda_on_sampled_pixels(const char* name, int width, int rows, const Functor& functor) {
  launch_cuda_in_steps(
      name, width, rows, DrawMiddle<Functor>{functor}, [&](const int* listed, const int* device_count) {
        const int count = read_cuda(device_count, name);
        if (count == 0) {
          return;
        }
        constexpr int pixels_a_block = pixel_block / (near_samples * near_samples);
        draw_samples<<<(count - 1) / pixels_a_block + 1, pixel_block, 0, current_stream()>>>(functor, listed, count);
      });
}

}  // namespace ergodome
