#pragma once

#include "render/passes/disk/disk_camera.h"

namespace ergodome {

//! Fills nodes_along_r and nodes_along_theta of a disk's grid.
//!
//! Central differences of nodes at their (γ, s), 1 % of the way to the horizon off, and 0.01 rad or half of the way to the plane of the disk. In the
//! plane itself layers leap: they are told no change along θ there, nor within 2e-4 rad of it.
void add_disk_derivatives(DiskStation& station, const DiskGridSettings& settings);

//! Adds a part of a set of nodes to a sum of as many floats, for a camera that is `offset` away from a station with derivatives, to first order; of
//! one without, as they are.
void add_moved_nodes(const DiskStation& station, const LensPlace& offset, int set, float part, std::vector<float>& sum);

}  // namespace ergodome
