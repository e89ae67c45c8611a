#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "content/trajectory/disk_station.h"
#include "content/trajectory/station_cells.h"

namespace ergodome {

//! A station's disk layers as the payload of their frame.
PackedBytes pack_disk(const DiskStation& station);

//! The layers of a payload. Throws Error, naming the place, for anything that kernels could not read safely: it need not come from pack_disk.
DiskStation unpack_disk(std::span<const std::byte> packed, std::uint64_t unpacked_bytes, const std::string& place);

//! The same from bytes that are not compressed.
DiskStation parse_disk_layout(std::span<const std::byte> raw, const std::string& place);

//! What parse_disk_layout reads.
Bytes disk_layout(const DiskStation& station);

}  // namespace ergodome
