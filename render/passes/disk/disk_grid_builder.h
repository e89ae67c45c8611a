#pragma once

#include "content/trajectory/disk_station.h"
#include "render/lens/grid/growing_grid.h"
#include "render/passes/disk/disk_camera.h"
#include "render/passes/disk/disk_grid_tracer.h"

namespace ergodome {

//! Builds the grid of a disk for a camera at Boyer-Lindquist (r, θ) [M, rad], on either side of the
//! horizon. can_have_disk_grid() must be true for the disk.
//!
//! Checks each cell that may show an image of the disk against rays traced at two points inside it
//! and at the midpoints of its sides. Splits it if the interpolated nodes differ by more than 0.8
//! of the budget, along the axis with the larger error. Also splits cells whose checks may miss an
//! image, such as cells whose rays start both far above and far below the plane: a camera near the
//! plane sees the disk as a line. Cells that are still inaccurate at the maximum depth, below
//! `min_area_px` or when `max_nodes` is reached are flagged, so that their pixels are traced.
//!
//! For a camera on the equator, only half of the grid is built; it is mirrored when it is read.
//! Rays are single precision, like those of pixels.
DiskStation build_disk_station(Spacetime spacetime, double r, double theta, const DiskGridSettings& settings,
                               GridStatistics* statistics = nullptr, DiskGridTracer* tracer = nullptr);

}  // namespace ergodome
