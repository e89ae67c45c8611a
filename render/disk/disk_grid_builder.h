#pragma once

#include "kernels/metric/frame_boost.h"
#include "render/disk/disk_grid_tracer.h"
#include "render/disk/disk_station.h"

namespace ergodome {

//! What a disk's grid is built for.
struct DiskGridSettings {
  double inner_r = 6.0;  //!< edges of the disk [M]
  double outer_r = 20.0;
  bool pattern = false;        //!< azimuth and time, too
  double pixel = 1e-3;         //!< angle of a pixel on the screen [rad]
  double budget_px = 0.25;     //!< greatest displacement on the screen
  Aberration observer{};       //!< whose screen: from aberration_to_rain()
  double least_area_px = 3.0;  //!< a cell smaller than this is not split: tracing its pixels is cheaper than its nodes
  int most_nodes = 1 << 16;    //!< what is bad still when there are so many is left to rays
};

//! What a build did.
struct DiskGridStatistics {
  int nodes = 0;
  int leaves = 0;
  int flagged_leaves = 0;
  long traced_nodes = 0;
  long traced_checks = 0;
  double flagged_px = 0.0;  //!< area of the flagged leaves on the screen [px²]
};

//! Builds the grid of a disk for a camera at Boyer-Lindquist (r, θ) [M, rad], outside the horizon. The disk must have an outside.
//!
//! Cells in which an image of the disk may be seen are split where traced rays in their middles and the middles of their sides miss the patch by
//! more than 0.8 of the budget, along the axis that misses more, and where light starts both far above and far below the plane as seen from it: a camera
//! near the plane sees the disk as a line. What stays bad at the depth limit or at `least_area_px` is flagged: its pixels are to be traced. A
//! camera on the equator gets half a grid, mirrored on reading. Rays are in float, as those of pixels are.
DiskStation build_disk_station(double spin, double r, double theta, const DiskGridSettings& settings,
                               DiskGridStatistics* statistics = nullptr, DiskGridTracer* tracer = nullptr);

//! How far rays of a disk's grid are followed; the tolerance is left open.
LayerLimits<double> layer_limits(double spin, double inner_r, double outer_r);

}  // namespace ergodome
