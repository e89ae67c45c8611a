#include "content/trajectory/station_frame.h"

#include "content/trajectory/disk_codec.h"
#include "content/trajectory/frame.h"
#include "content/trajectory/station_codec.h"

namespace ergodome {

namespace {

StationSummary read_summary(ByteReader& from) {
  StationSummary summary;
  summary.time_s = from.number<double>();
  summary.r = from.number<double>();
  summary.theta = from.number<double>();
  summary.nodes = from.number<std::uint32_t>();
  summary.leaves = from.number<std::uint32_t>();
  return summary;
}

}  // namespace

Bytes make_station_frame(std::uint32_t number, double time_s, const LensStation& station) {
  ByteWriter payload;
  payload.number(time_s);
  payload.number(station.r);
  payload.number(station.theta);
  payload.number(static_cast<std::uint32_t>(station.node_count()));
  payload.number(static_cast<std::uint32_t>(station.leaf_count()));
  const PackedBytes packed = pack_station(station);
  payload.append(packed.bytes);
  return make_frame(FrameKind::station, number, payload.bytes(), packed.unpacked_bytes);
}

Bytes make_disk_frame(std::uint32_t number, double time_s, const DiskStation& disk) {
  ByteWriter payload;
  payload.number(time_s);
  const PackedBytes packed = pack_disk(disk);
  payload.append(packed.bytes);
  return make_frame(FrameKind::disk, number, payload.bytes(), packed.unpacked_bytes);
}

Bytes renumbered(std::span<const std::byte> frame, std::uint32_t number, const std::string& place) {
  const FrameHeader header = parse_frame_header(frame, place);
  return make_frame(header.kind, number, checked_payload(frame, header.kind, place), header.unpacked_bytes);
}

StationSummary parse_summary(std::span<const std::byte> frame, const std::string& place) {
  ByteReader from(checked_payload(frame, FrameKind::station, place), place);
  return read_summary(from);
}

LensStation parse_station(std::span<const std::byte> frame, const std::string& place) {
  ByteReader from(checked_payload(frame, FrameKind::station, place), place);
  const StationSummary summary = read_summary(from);
  LensStation station = unpack_station(from.take(from.left()), parse_frame_header(frame, place).unpacked_bytes, place);
  if (station.r != summary.r || station.theta != summary.theta) {
    throw Error(place, "is damaged (position)", "bake it again");
  }
  return station;
}

double parse_disk_time(std::span<const std::byte> frame, const std::string& place) {
  return ByteReader(checked_payload(frame, FrameKind::disk, place), place).number<double>();
}

DiskStation parse_disk(std::span<const std::byte> frame, const std::string& place) {
  ByteReader from(checked_payload(frame, FrameKind::disk, place), place);
  from.number<double>();
  return unpack_disk(from.take(from.left()), parse_frame_header(frame, place).unpacked_bytes, place);
}

}  // namespace ergodome
