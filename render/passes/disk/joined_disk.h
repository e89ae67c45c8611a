#pragma once

#include <optional>

#include "content/trajectory/disk_station.h"

namespace ergodome {

//! The layers of two stations on common cells, each as small as the finer of both. Layers between
//! the stations are then sums of nodes, and pictures read one grid. Dividing a cell does not change
//! its cubic patch.
struct JoinedDisk {
  DiskStation first;   //!< with the cells, and the orders seen in either station
  DiskStation second;  //!< without cells; position and nodes only
};

//! Joins the layers of two stations. A cell has the orders of both stations, and is left to rays if
//! either station leaves it. Returns nothing if the stations have different disks, if only one of
//! them is on the equator, or if their cells differ so much that there would be too many.
std::optional<JoinedDisk> join(const DiskStation& first, const DiskStation& second);

}  // namespace ergodome
