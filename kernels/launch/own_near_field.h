#pragma once

#include "kernels/core/host_device.h"
#include "kernels/disk/draw_disk.h"

namespace ergodome::inline ERGO_TARGET {

//! Draws the disk over pixels [begin, end); see DiskBatch. In a source of its own, so that it changes nothing in how other kernels are compiled.
void draw_disk(const DiskBatch& batch, int begin, int end);

}  // namespace ergodome::inline ERGO_TARGET
