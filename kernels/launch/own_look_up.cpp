#include "kernels/launch/own_look_up.h"

#include "kernels/lens/look_up_kernel.h"

// Compiled once per instruction set; ERGO_TARGET names it.
namespace ergodome::inline ERGO_TARGET {

namespace {

template <template <class, bool> class Functor, class Batch>
void run(const Batch& batch, bool footprints, int begin, int end) {
  const auto visit = [&](const auto& functor) {
    for (int index = begin; index < end; ++index) {
      functor(index);
    }
  };
  if (footprints) {
    visit(Functor<WidePack<float>, true>{batch});
  } else {
    visit(Functor<WidePack<float>, false>{batch});
  }
}

template <class T, bool Footprints>
using LookUpOneEye = LookUpPixels<T, Footprints, LookUpBatch>;

}  // namespace

void look_up_pixels(const LookUpBatch& batch, int begin, int end) {
  run<LookUpOneEye>(batch, has_footprints(batch.pixels.out), begin, end);
}

void look_up_pixel_pairs(const LookUpPairBatch& batch, int begin, int end) {
  run<LookUpPixelPairs>(batch, has_footprints(batch.eyes[0].pixels.out), begin, end);
}

}  // namespace ergodome::inline ERGO_TARGET
