#pragma once

#include <span>
#include <string>

#include "content/trajectory/disk_station.h"
#include "content/trajectory/trajectory.h"

namespace ergodome {

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
Bytes renumbered(std::span<const std::byte> frame, std::uint32_t number, const std::string& place);

//! Parse frames. Throw Error, which names `place`, if the frame is damaged. parse_summary() and
//! parse_disk_time() do not decompress it.
StationSummary parse_summary(std::span<const std::byte> frame, const std::string& place);
LensStation parse_station(std::span<const std::byte> frame, const std::string& place);
double parse_disk_time(std::span<const std::byte> frame, const std::string& place);
DiskStation parse_disk(std::span<const std::byte> frame, const std::string& place);

}  // namespace ergodome
