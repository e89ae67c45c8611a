#include <cstdint>

#include "kernels/image/light_texels_kernel.h"
#include "kernels/image/warp_pixel_kernel.h"
#include "kernels/launch/launch_on_cuda.cuh"

namespace ergodome {

namespace {

//! A CUDA warp (32 threads) covers adjacent pixels of a row, so their bytes can be written as
//! words; rows of a block read the same texels.
constexpr int columns_of_a_block = 32;
constexpr int rows_of_a_block = 8;

//! Writes the 32 adjacent pixels of a CUDA warp as words, red in the lowest byte. `count` is the
//! number of bytes inside the row, a multiple of 4.
__device__ void store_words(std::uint8_t* to, std::uint32_t rgb, int count) {
  constexpr unsigned all = 0xffffffffU;
  const int first_byte = 4 * static_cast<int>(threadIdx.x);
  // The four bytes of a word come from two adjacent pixels.
  const std::uint32_t one = __shfl_sync(all, rgb, first_byte / 3 % columns_of_a_block);
  const std::uint32_t next = __shfl_sync(all, rgb, (first_byte / 3 + 1) % columns_of_a_block);
  if (first_byte < count) {
    *reinterpret_cast<std::uint32_t*>(to + first_byte) =
        __funnelshift_r(one | next << 24U, next >> 8U, 8U * static_cast<unsigned>(first_byte % 3));
  }
}

template <bool Coloured>
__global__ void warp_rows(const __grid_constant__ WarpPixel<Coloured> functor, bool by_words) {
  const int left = static_cast<int>(blockIdx.x) * columns_of_a_block;
  const int x = left + static_cast<int>(threadIdx.x);
  const int y = static_cast<int>(blockIdx.y) * rows_of_a_block + static_cast<int>(threadIdx.y);
  const int width = functor.batch.width_px;
  if (y >= functor.batch.height_px) {
    return;
  }
  const bool inside = x < width;
  const std::uint32_t rgb = inside ? functor.sent(x, y) : 0U;
  const long row = static_cast<long>(y) * width;
  if (by_words) {
    const int pixels = width - left < columns_of_a_block ? width - left : columns_of_a_block;
    store_words(functor.batch.rgb + 3 * (row + left), rgb, 3 * pixels);
  } else if (inside) {
    functor.store(row + x, rgb);
  }
}

template <bool Coloured>
void enqueue_warp(const WarpBatch& batch) {
  const dim3 blocks(static_cast<unsigned>((batch.width_px - 1) / columns_of_a_block + 1),
                    static_cast<unsigned>((batch.height_px - 1) / rows_of_a_block + 1));
  const bool by_words = batch.width_px % 4 == 0 && reinterpret_cast<std::uintptr_t>(batch.rgb) % 4 == 0;
  warp_rows<Coloured><<<blocks, dim3(columns_of_a_block, rows_of_a_block), 0, current_stream()>>>(
      WarpPixel<Coloured>{batch}, by_words);
  check_cuda(cudaGetLastError(), "warp_pixels");
}

}  // namespace

template <>
void launch_on_cuda(const ToneBatch& batch) {
  enqueue_cuda("tone_tiles", batch.count * light_tile_texels, ToneTexels{batch});
}

template <>
void launch_on_cuda(const AverageBatch& batch) {
  enqueue_cuda("average_tiles", batch.count * light_tile_texels, AverageTexels{batch});
}

template <>
void launch_on_cuda(const WarpBatch& batch) {
  if (batch.width_px <= 0 || batch.height_px <= 0) {
    return;
  }
  if (batch.coloured) {
    enqueue_warp<true>(batch);
  } else {
    enqueue_warp<false>(batch);
  }
}

}  // namespace ergodome
