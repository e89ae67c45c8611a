#pragma once

#include <memory>

#include "content/disk_station.h"

namespace ergodome {

//! The layers of two stations over one set of cells, which are as fine as those of both: so layers between them are a sum of nodes, and pictures
//! read one grid. Cubic patches stay what they are where cells are divided.
struct JoinedDisk {
  DiskStation first;   //!< with the cells, and their images of either
  DiskStation second;  //!< its place and its nodes alone
};

//! Whether the layers of two stations can be joined: they are of one disk, and no camera is on the equator, or both are.
bool can_join(const DiskStation& first, const DiskStation& second);

//! Joins them. Images are told where either tells them, and left to rays where either leaves them.
JoinedDisk join(const DiskStation& first, const DiskStation& second);

}  // namespace ergodome
