#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "content/trajectory/bytes.h"
#include "content/trajectory/lens_station.h"
#include "content/trajectory/station_cells.h"

namespace ergodome {

//! A station as the payload of its frame.
PackedBytes pack_station(const LensStation& station);

//! The station of a payload. Throws Error, naming the place, for anything that kernels could not read safely: it need not come from
//! pack_station.
LensStation unpack_station(std::span<const std::byte> packed, std::uint64_t unpacked_bytes, const std::string& place);

//! The same from bytes that are not compressed.
LensStation parse_station_layout(std::span<const std::byte> raw, const std::string& place);

//! What parse_station_layout reads.
Bytes station_layout(const LensStation& station);

}  // namespace ergodome
