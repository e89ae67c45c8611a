#pragma once

#include "kernels/core/host_device.h"
#include "kernels/disk/disk_grid.h"

// Kernels for grids of a disk's images, compiled once per instruction set.
namespace ergodome::inline ERGO_TARGET {

void trace_disk_nodes(const DiskNodeBatch& batch, int begin, int end);
void check_disk_cells(const DiskCheckBatch& batch, int begin, int end);
void check_disk_grid(const DiskGridCheckBatch& batch, int begin, int end);
void look_up_disk(const DiskLookUpBatch& batch, int begin, int end);

}  // namespace ergodome::inline ERGO_TARGET
