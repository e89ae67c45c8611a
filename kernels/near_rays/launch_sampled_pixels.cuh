#pragma once

#include "kernels/launch/launch_on_cuda.cuh"
#include "kernels/near_rays/seen_light.h"

// Launches that draw pixels of which few need many samples.
namespace ergodome {

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
