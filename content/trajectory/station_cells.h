#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "content/files/bytes.h"
#include "content/trajectory/lens_station.h"

// The part of the format that stations of every kind share: position, chart and cells.
// content/docs/reference/trajectory-file.md describes every byte.
namespace ergodome {

//! Bits of a station's flags.
enum StationFlag : std::uint32_t { station_is_mirrored = 1, station_has_derivatives = 2, station_has_pattern = 4 };

//! Appends position, chart and cells of a station that has `nodes` nodes, which are stored
//! elsewhere.
void write_cells(ByteWriter& to, const LensStation& station, std::uint32_t flags, std::size_t nodes);

//! The result of reading what write_cells() wrote.
struct StationCells {
  LensStation station;  //!< position, chart and cells of the station, without nodes
  std::uint32_t flags;
  std::size_t nodes;
};

//! Reads what write_cells() wrote. `stored_floats` is the minimum number of floats per node that
//! follow. Throws Error, which names `location`, if the data cannot be read safely or if no camera
//! can be at the station's position.
StationCells read_cells(ByteReader& from, std::size_t stored_floats, const std::string& location);

//! A losslessly compressed payload of a frame.
struct PackedBytes {
  Bytes bytes;
  std::uint64_t unpacked_bytes;
};
PackedBytes pack_bytes(std::span<const std::byte> raw);

//! Decompresses a payload. Throws Error, which names `location`, if its size differs from
//! `unpacked_bytes`.
Bytes unpack_bytes(std::span<const std::byte> packed, std::uint64_t unpacked_bytes, const std::string& location);

//! Throws Error for a damaged station unless `good`.
void require_whole(bool good, const char* what, const std::string& location);

//! Returns true if all numbers are finite.
bool all_finite(const std::vector<float>& numbers);

}  // namespace ergodome
