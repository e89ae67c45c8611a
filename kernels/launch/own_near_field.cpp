#include "kernels/launch/own_near_field.h"

#include "kernels/near_field/draw_near_field_kernel.h"

// Compiled once per instruction set; ERGO_TARGET names it.
namespace ergodome::inline ERGO_TARGET {

void draw_near_field(const NearFieldBatch& batch, int begin, int end) {
  dispatch_near_field<DrawNearField, WidePack<float>>(batch, [&](const auto& draw) {
    for (int index = begin; index < end; ++index) {
      draw(index);
    }
  });
}

}  // namespace ergodome::inline ERGO_TARGET
