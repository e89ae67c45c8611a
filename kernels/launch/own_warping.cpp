#include "kernels/launch/own_warping.h"

#include "kernels/image/light_levels_kernel.h"
#include "kernels/image/warp_pixels_kernel.h"

// Compiled once per instruction set; ERGO_TARGET names it.
namespace ergodome::inline ERGO_TARGET {

namespace {

template <class Functor, class Batch>
void run(const Batch& batch, int begin, int end) {
  const Functor functor{batch};
  for (int index = begin; index < end; ++index) {
    functor(index);
  }
}

}  // namespace

void tone_tiles(const ToneBatch& batch, int begin, int end) { run<ToneTiles<WidePack<float>>>(batch, begin, end); }

void average_tiles(const AverageBatch& batch, int begin, int end) { run<AverageTiles>(batch, begin, end); }

void warp_pixels(const WarpBatch& batch, int begin, int end) {
  if (batch.coloured) {
    run<WarpPixels<WidePack<float>, true>>(batch, begin, end);
  } else {
    run<WarpPixels<WidePack<float>, false>>(batch, begin, end);
  }
}

}  // namespace ergodome::inline ERGO_TARGET
