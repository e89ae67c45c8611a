#pragma once

#include "render/passes/disk/disk_camera.h"

namespace ergodome {

//! Fills nodes_along_r and nodes_along_theta of a disk grid.
//!
//! Uses central differences of nodes at fixed (γ, s), with steps of ±1 % of radial_measure() in r
//! and of ±0.01 rad in θ, or half the distance to the plane of the disk if that is smaller. In the
//! plane itself layers are discontinuous: the derivative along θ is set to zero there and within
//! 2e-4 rad.
void add_disk_derivatives(DiskStation& station, const DiskGridSettings& settings);

//! Adds `part` times a set of nodes to `sum`. If the station has derivatives along the camera's r
//! and θ, the nodes are first extrapolated to first order to a camera at `offset` from the station.
void add_moved_nodes(const DiskStation& station, const LensPosition& offset, int set, float part,
                     std::vector<float>& sum);

}  // namespace ergodome
