#pragma once

#include "content/trajectory/disk_station.h"
#include "render/lens/grid/growing_grid.h"
#include "render/passes/disk/disk_camera.h"
#include "render/passes/disk/disk_grid_tracer.h"

namespace ergodome {

//! Builds the grid of a disk for a camera at Boyer-Lindquist (r, θ) [M, rad], outside the horizon.
//! The disk must have an outer edge.
//!
//! Splits cells that may show an image of the disk if traced rays in their middles or at the
//! midpoints of their sides miss the patch by more than 0.8 of the budget, along the axis with the
//! larger error. Also splits cells whose rays start both far above and far below the plane: a
//! camera near the plane sees the disk as a line. Cells that are still inaccurate at the depth
//! limit or at `least_area_px` are flagged, so that their pixels are traced. A camera on the
//! equator gets half a grid, which is mirrored when read. Rays are single precision, like those of
//! pixels.
DiskStation build_disk_station(Spacetime spacetime, double r, double theta, const DiskGridSettings& settings,
                               GridStatistics* statistics = nullptr, DiskGridTracer* tracer = nullptr);

}  // namespace ergodome
