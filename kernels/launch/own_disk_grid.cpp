#include "kernels/launch/own_disk_grid.h"

#include "kernels/disk/check_disk_grid_kernel.h"
#include "kernels/disk/disk_grid_kernel.h"
#include "kernels/disk/look_up_disk_kernel.h"

// Compiled once per instruction set; ERGO_TARGET names it.
namespace ergodome::inline ERGO_TARGET {

namespace {

template <template <class, bool> class Functor, class Batch>
void run_on_disk(bool pattern, const Batch& batch, int begin, int end) {
  const auto run = [&](const auto& functor) {
    for (int index = begin; index < end; ++index) {
      functor(index);
    }
  };
  if (pattern) {
    run(Functor<WidePack<float>, true>{batch});
  } else {
    run(Functor<WidePack<float>, false>{batch});
  }
}

}  // namespace

void trace_disk_nodes(const DiskNodeBatch& batch, int begin, int end) {
  run_on_disk<TraceDiskNodes>(batch.camera.pattern, batch, begin, end);
}

void check_disk_cells(const DiskCheckBatch& batch, int begin, int end) {
  run_on_disk<CheckDiskCells>(batch.camera.pattern, batch, begin, end);
}

void check_disk_grid(const DiskGridCheckBatch& batch, int begin, int end) {
  run_on_disk<CheckDiskGrid>(batch.camera.pattern, batch, begin, end);
}

void look_up_disk(const DiskLookUpBatch& batch, int begin, int end) {
  run_on_disk<LookUpDisk>(batch.near_field.drawing == DiskDrawing::pattern, batch, begin, end);
}

}  // namespace ergodome::inline ERGO_TARGET
