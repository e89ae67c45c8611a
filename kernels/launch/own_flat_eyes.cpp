#include "kernels/launch/own_flat_eyes.h"

#include "kernels/eyes/flat/draw_flat_eyes_kernel.h"
#include "kernels/eyes/flat/look_up_flat_eyes_kernel.h"

// Compiled once per instruction set; ERGO_TARGET names it.
namespace ergodome::inline ERGO_TARGET {

void draw_flat_eyes(const FlatEyeBatch& batch, int begin, int end) {
  dispatch_flat_eyes<WidePack<float>>(batch, [begin, end](const auto& draw) {
    for (int index = begin; index < end; ++index) {
      draw(index);
    }
  });
}

void look_up_flat_eyes(const FlatEyeLookUpBatch& batch, int begin, int end) {
  const auto run = [begin, end](const auto& look_up) {
    for (int index = begin; index < end; ++index) {
      look_up(index);
    }
  };
  if (batch.eye.near_field.drawing == DiskDrawing::pattern) {
    run(LookUpFlatEyes<WidePack<float>, true>{batch});
  } else {
    run(LookUpFlatEyes<WidePack<float>, false>{batch});
  }
}

}  // namespace ergodome::inline ERGO_TARGET
