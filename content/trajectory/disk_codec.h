#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "content/trajectory/disk_station.h"
#include "content/trajectory/station_cells.h"

namespace ergodome {

//! Returns a station's disk layers as the compressed payload of their frame.
PackedBytes pack_disk(const DiskStation& station);

//! Decodes disk layers from a payload. Accepts untrusted data: throws Error, which names `place`,
//! for anything that kernels could not read safely.
DiskStation unpack_disk(std::span<const std::byte> packed, std::uint64_t unpacked_bytes, const std::string& place);

//! Decodes disk layers from uncompressed bytes in the same way.
DiskStation parse_disk_layout(std::span<const std::byte> raw, const std::string& place);

//! Returns the uncompressed bytes of disk layers.
Bytes disk_layout(const DiskStation& station);

}  // namespace ergodome
