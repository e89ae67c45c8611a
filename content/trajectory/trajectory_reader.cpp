#include "content/trajectory/trajectory_reader.h"

#include <algorithm>

#include "content/trajectory/frame.h"
#include "content/trajectory/station_cells.h"
#include "content/trajectory/station_codec.h"

namespace ergodome {

namespace {

constexpr const char* not_there = "a station that does not match the index";

//! Reads the complete frame at an offset.
Bytes read_frame(const DataFile& file, std::uint64_t offset, const std::string& location) {
  const Bytes header = file.read(offset, frame_header_bytes, location);
  return file.read(offset, frame_header_bytes + parse_frame_header(header, location).payload_bytes, location);
}

}  // namespace

TrajectoryReader::TrajectoryReader(const std::filesystem::path& path) : file_(DataFile::open(path)) {
  const std::string name = path.string();
  file_bytes_ = file_.size();
  const TrajectoryHeader header =
      parse_trajectory_header(file_.read(0, std::min<std::uint64_t>(file_bytes_, trajectory_header_bytes), name), name);
  if (!header.sealed) {
    throw Error(name, "is an unfinished bake",
                "finish it with ergodome bake SHOW --out FILE, where FILE is this name without .part");
  }
  if (header.file_bytes != file_bytes_) {
    throw Error(name, "does not have its original size", "copy it again, or bake it again");
  }
  const std::string index_position = name + ": index";
  if (header.index_bytes > largest_frame_bytes || header.index_bytes < frame_header_bytes ||
      header.index_offset > file_bytes_ || header.index_bytes > file_bytes_ - header.index_offset) {
    throw Error(name, "has a damaged header", "bake it again");
  }
  const std::string provenance_position = name + ": provenance";
  const Bytes provenance = read_frame(file_, trajectory_header_bytes, provenance_position);
  provenance_ =
      parse_provenance(checked_payload(provenance, FrameKind::provenance, provenance_position), provenance_position);
  const Bytes index = file_.read(header.index_offset, header.index_bytes, index_position);
  stations_ = parse_index(checked_payload(index, FrameKind::index, index_position), index_position);
  if (stations_.size() != header.station_count || stations_.empty()) {
    throw Error(index_position, "is damaged (number of stations)", "bake it again");
  }
}

Bytes TrajectoryReader::frame_at(std::uint64_t offset, std::uint64_t bytes, const std::string& location) const {
  require_whole(offset <= file_bytes_ && bytes <= file_bytes_ - offset && bytes >= frame_header_bytes &&
                    bytes <= largest_frame_bytes,
                not_there, location);
  return file_.read(offset, bytes, location);
}

LensStation TrajectoryReader::read(std::size_t station) const {
  const StationEntry& entry = stations_.at(station);
  const std::string location = station_position(path(), station);
  const Bytes frame = frame_at(entry.offset, entry.bytes, location);
  LensStation read = parse_station(frame, location);
  require_whole(parse_frame_header(frame, location).number == station && read.r == entry.r &&
                    read.theta == entry.theta && read.spacetime == provenance_.spacetime &&
                    read.nodes_along_r.empty() != provenance_.derivatives,
                not_there, location);
  return read;
}

DiskStation TrajectoryReader::read_disk(std::size_t station) const {
  const StationEntry& entry = stations_.at(station);
  const std::string location = station_position(path(), station) + ", disk";
  // Compares with a difference, because a sum of unchecked numbers from the file could overflow.
  require_whole(entry.offset <= file_bytes_ && entry.bytes <= file_bytes_ - entry.offset, not_there, location);
  const Bytes frame = frame_at(entry.offset + entry.bytes, entry.disk_bytes, location);
  const FrameHeader header = parse_frame_header(frame, location);
  require_whole(header.unpacked_bytes == entry.disk_memory_bytes, not_there, location);
  DiskStation read = parse_disk(frame, location);
  require_whole(header.number == station && read.cells.r == entry.r && read.cells.theta == entry.theta &&
                    read.cells.spacetime == provenance_.spacetime && read.has_derivatives() == provenance_.derivatives,
                not_there, location);
  return read;
}

}  // namespace ergodome
