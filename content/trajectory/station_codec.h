#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "content/trajectory/bytes.h"
#include "content/trajectory/lens_station.h"
#include "content/trajectory/station_cells.h"

namespace ergodome {

//! Returns a station as the compressed payload of its frame.
PackedBytes pack_station(const LensStation& station);

//! Decodes a station from a payload. Accepts untrusted data: throws Error, which names `place`, for
//! anything that kernels could not read safely.
LensStation unpack_station(std::span<const std::byte> packed, std::uint64_t unpacked_bytes, const std::string& place);

//! Decodes a station from uncompressed bytes in the same way.
LensStation parse_station_layout(std::span<const std::byte> raw, const std::string& place);

//! Returns the uncompressed bytes of a station.
Bytes station_layout(const LensStation& station);

}  // namespace ergodome
