#pragma once

#include "content/trajectory/disk_station.h"
#include "render/lens/grid/growing_grid.h"
#include "render/passes/disk/disk_camera.h"
#include "render/passes/disk/disk_grid_tracer.h"

namespace ergodome {

//! Builds the grid of a disk for a camera at Boyer-Lindquist (r, θ) [M, rad], outside the horizon. The disk must have an outside.
//!
//! Cells in which an image of the disk may be seen are split where traced rays in their middles and the middles of their sides miss the patch by
//! more than 0.8 of the budget, along the axis that misses more, and where light starts both far above and far below the plane as seen from it: a camera
//! near the plane sees the disk as a line. What stays bad at the depth limit or at `least_area_px` is flagged: its pixels are to be traced. A
//! camera on the equator gets half a grid, mirrored on reading. Rays are in float, as those of pixels are.
DiskStation build_disk_station(double spin, double r, double theta, const DiskGridSettings& settings,
                               GridStatistics* statistics = nullptr, DiskGridTracer* tracer = nullptr);

}  // namespace ergodome
