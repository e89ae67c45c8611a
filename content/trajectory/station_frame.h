#pragma once

#include <span>
#include <string>

#include "content/trajectory/disk_station.h"
#include "content/trajectory/trajectory.h"

namespace ergodome {

//! What a station's frame says of it before its compressed part: enough for an index.
struct StationSummary {
  double time_s = 0.0;
  double r = 0.0;
  double theta = 0.0;
  std::uint32_t nodes = 0;
  std::uint32_t leaves = 0;
};

//! A station's frame; `number` counts from 0.
Bytes make_station_frame(std::uint32_t number, double time_s, const LensStation& station);

//! The frame of a station's disk layers.
Bytes make_disk_frame(std::uint32_t number, double time_s, const DiskStation& disk);

//! The same frame, a station's or of its disk layers, under another number, its payload untouched.
Bytes renumbered(std::span<const std::byte> frame, std::uint32_t number, const std::string& place);

//! All throw Error, naming the place, where the frame is damaged. The summary and the time do not look into the compressed part.
StationSummary parse_summary(std::span<const std::byte> frame, const std::string& place);
LensStation parse_station(std::span<const std::byte> frame, const std::string& place);
double parse_disk_time(std::span<const std::byte> frame, const std::string& place);
DiskStation parse_disk(std::span<const std::byte> frame, const std::string& place);

}  // namespace ergodome
