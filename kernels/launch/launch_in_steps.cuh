#pragma once

#include "kernels/launch/launch_on_cuda.cuh"

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
