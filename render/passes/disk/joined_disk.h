#pragma once

#include <optional>

#include "content/trajectory/disk_station.h"

namespace ergodome {

//! The disk layers of two stations, converted to the same cells: each cell is as small as the
//! smaller one of the two stations. Layers between the stations are then weighted sums of nodes,
//! and pictures read a single grid. Dividing a cell does not change its interpolating cubic.
struct JoinedDisk {
  //! Includes the common cells, with the orders of crossing that are visible from either station.
  DiskStation first;
  DiskStation second;  //!< only position and nodes, without cells
};

//! Joins the layers of two stations. A cell has the orders of both stations, and is left to rays if
//! either station leaves it. Returns nothing if the stations differ in spin, root cells, disk
//! edges, pattern or whether they have derivatives along r and θ, if only one of them is on the
//! equator, or if their cells differ so much that the joined tree would have too many.
std::optional<JoinedDisk> join(const DiskStation& first, const DiskStation& second);

}  // namespace ergodome
