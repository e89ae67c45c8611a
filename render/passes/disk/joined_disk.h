#pragma once

#include <optional>

#include "content/trajectory/disk_station.h"

namespace ergodome {

//! The layers of two stations over one set of cells, which are as fine as those of both: so layers between them are a sum of nodes, and pictures
//! read one grid. Cubic patches stay what they are where cells are divided.
struct JoinedDisk {
  DiskStation first;   //!< with the cells, and their images of either
  DiskStation second;  //!< for its place and its nodes; it has no cells
};

//! Joins the layers of two stations. Images are told where either tells them, and left to rays where either leaves them. Nothing where the stations are
//! not of one disk, where one camera alone is on the equator, and where their cells have so little in common that there would be too many.
std::optional<JoinedDisk> join(const DiskStation& first, const DiskStation& second);

}  // namespace ergodome
