#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "content/trajectory/bytes.h"
#include "content/trajectory/lens_station.h"

// What stations of every kind have in their bytes: where they are, their chart and their cells. content/docs/reference/trajectory-file.md describes it byte by byte.
namespace ergodome {

//! Bits of a station's flags.
enum StationFlag : std::uint32_t { station_is_mirrored = 1, station_has_derivatives = 2, station_has_pattern = 4 };

//! Appends place, chart and cells of a station with so many nodes, wherever these are kept.
void write_cells(ByteWriter& to, const LensStation& station, std::uint32_t flags, std::size_t nodes);

//! What write_cells wrote, and more to come.
struct StationCells {
  LensStation station;  //!< without nodes
  std::uint32_t flags;
  std::size_t nodes;
};

//! Reads it. Throws Error, naming the place, where it could not be read safely or is of no camera; `stored_floats`: how many numbers
//! of each node follow at least.
StationCells read_cells(ByteReader& from, std::size_t stored_floats, const std::string& place);

//! Bytes as the payload of a frame: compressed, every bit of them kept.
struct PackedBytes {
  Bytes bytes;
  std::uint64_t unpacked_bytes;
};
PackedBytes pack_bytes(std::span<const std::byte> raw);

//! The bytes of a payload. Throws Error, naming the place, where they are not as many as they should be.
Bytes unpack_bytes(std::span<const std::byte> packed, std::uint64_t unpacked_bytes, const std::string& place);

//! Throws Error for a damaged station unless `good`.
void require_whole(bool good, const char* what, const std::string& place);

//! Whether all of a station's numbers are numbers.
bool all_finite(const std::vector<float>& numbers);

}  // namespace ergodome
