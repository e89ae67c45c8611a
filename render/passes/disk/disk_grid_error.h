#pragma once

#include "render/lens/grid/screen_error.h"
#include "render/passes/disk/disk_camera.h"

namespace ergodome {

//! Measures the error of a disk grid (in host memory) on the screen at a camera position, by
//! comparison with traced rays at sample points in the disk chart. Returns the quantiles of
//! ScreenError over the area in which the disk is seen [px]. `settings` describe the screen and
//! the disk.
ScreenError measure_disk_error(const DiskGrid& grid, Spacetime spacetime, const LensPosition& position,
                               const DiskGridSettings& settings, const ChartSamples& samples);

}  // namespace ergodome
