#pragma once

#include "render/lens/grid/screen_error.h"
#include "render/passes/disk/disk_camera.h"

namespace ergodome {

//! What a disk's grid (its arrays on the host) misses by on the screen at a place, by traced rays at the samples in the chart of disks: bounds for all
//! but a part of what shows the disk, by solid angle [px]. `settings`: for whose screen, and what disk.
ScreenError measure_disk_error(const DiskGrid& grid, double spin, const LensPlace& place,
                               const DiskGridSettings& settings, const ChartSamples& samples);

}  // namespace ergodome
