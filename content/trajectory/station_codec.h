#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "content/files/bytes.h"
#include "content/trajectory/disk_station.h"
#include "content/trajectory/lens_station.h"
#include "content/trajectory/station_cells.h"
#include "content/trajectory/trajectory.h"

namespace ergodome {

//! Returns a station as the compressed payload of its frame.
PackedBytes pack_station(const LensStation& station);

//! Decodes a station from a payload. Accepts untrusted data: throws Error, which names `location`,
//! for anything that kernels could not read safely.
LensStation unpack_station(std::span<const std::byte> packed, std::uint64_t unpacked_bytes,
                           const std::string& location);

//! Decodes a station from the uncompressed bytes of station_layout(). Throws Error as
//! unpack_station() does.
LensStation parse_station_layout(std::span<const std::byte> raw, const std::string& location);

//! Returns the uncompressed bytes of a station.
Bytes station_layout(const LensStation& station);

//! Returns a station's disk layers as the compressed payload of their frame.
PackedBytes pack_disk(const DiskStation& station);

//! Decodes disk layers from a payload. Accepts untrusted data: throws Error, which names
//! `location`, for anything that kernels could not read safely.
DiskStation unpack_disk(std::span<const std::byte> packed, std::uint64_t unpacked_bytes, const std::string& location);

//! Decodes disk layers from the uncompressed bytes of disk_layout(). Throws Error as unpack_disk()
//! does.
DiskStation parse_disk_layout(std::span<const std::byte> raw, const std::string& location);

//! Returns the uncompressed bytes of disk layers.
Bytes disk_layout(const DiskStation& station);

//! The uncompressed metadata at the beginning of a station's frame, sufficient for an index.
struct StationSummary {
  double time_s = 0.0;
  double r = 0.0;
  double theta = 0.0;
  std::uint32_t nodes = 0;
  std::uint32_t leaves = 0;
};

//! Returns a station's frame; `number` counts from 0.
Bytes make_station_frame(std::uint32_t number, double time_s, const LensStation& station);

//! Returns the frame of a station's disk layers.
Bytes make_disk_frame(std::uint32_t number, double time_s, const DiskStation& disk);

//! Returns a station's or disk's frame with another number and an unchanged payload.
Bytes renumbered(std::span<const std::byte> frame, std::uint32_t number, const std::string& location);

//! Parse frames. Throw Error, which names `location`, if the frame is damaged. parse_summary() and
//! parse_disk_time() do not decompress it.
StationSummary parse_summary(std::span<const std::byte> frame, const std::string& location);
LensStation parse_station(std::span<const std::byte> frame, const std::string& location);
double parse_disk_time(std::span<const std::byte> frame, const std::string& location);
DiskStation parse_disk(std::span<const std::byte> frame, const std::string& location);

}  // namespace ergodome
