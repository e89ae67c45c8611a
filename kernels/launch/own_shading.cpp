#include "kernels/launch/own_shading.h"

#include "kernels/image/shade_pixels_kernel.h"

// Compiled once per instruction set; ERGO_TARGET names it.
namespace ergodome::inline ERGO_TARGET {

void shade_sky(const ShadeBatch& batch, int begin, int end) {
  dispatch_shading<WidePack<float>>(batch, [&](const auto& functor) {
    for (int index = begin; index < end; ++index) {
      functor(index);
    }
  });
}

}  // namespace ergodome::inline ERGO_TARGET
