#include "kernels/launch/own_disk.h"

#include "kernels/disk/draw_disk_kernel.h"

// Compiled once per instruction set; ERGO_TARGET names it.
namespace ergodome::inline ERGO_TARGET {

namespace {

template <bool WithPattern>
void run(const DiskBatch& batch, int begin, int end) {
  const DrawDisk<WidePack<float>, WithPattern> draw{batch};
  for (int index = begin; index < end; ++index) {
    draw(index);
  }
}

}  // namespace

void draw_disk(const DiskBatch& batch, int begin, int end) {
  if (has_pattern(batch.look)) {
    run<true>(batch, begin, end);
  } else {
    run<false>(batch, begin, end);
  }
}

}  // namespace ergodome::inline ERGO_TARGET
