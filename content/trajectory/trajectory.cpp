#include "content/trajectory/trajectory.h"

#include <fmt/format.h>

#include <cmath>

namespace ergodome {

namespace {

constexpr std::size_t entry_bytes = 64;
constexpr std::uint32_t flag_derivatives = 1;
constexpr std::uint32_t flag_disk = 2;

}  // namespace

MissedGaps missed_gaps(const std::vector<StationEntry>& stations, double limit_px) {
  MissedGaps missed;
  for (std::size_t i = 0; i + 1 < stations.size(); ++i) {
    const StationEntry& begin = stations[i];
    const auto error_px = static_cast<double>(begin.gap_error_px);
    if (!(error_px > limit_px)) {
      continue;
    }
    ++missed.count;
    missed.seconds += stations[i + 1].time_s - begin.time_s;
    if (error_px > missed.worst_px) {
      missed.worst_px = error_px;
      missed.worst_time_s = 0.5 * (begin.time_s + stations[i + 1].time_s);
    }
  }
  return missed;
}

std::string station_position(const std::filesystem::path& file, std::size_t station) {
  return fmt::format("{}: station {}", file.string(), station + 1);
}

Bytes to_bytes(const TrajectoryProvenance& provenance) {
  ByteWriter to;
  to.number(provenance.spacetime.spin);
  to.number(provenance.pixel);
  to.number(provenance.budget_px);
  to.number((provenance.derivatives ? flag_derivatives : 0U) | (provenance.disk ? flag_disk : 0U));
  to.text(provenance.code_version);
  to.text(provenance.show_text);
  return to.take();
}

TrajectoryProvenance parse_provenance(std::span<const std::byte> payload, const std::string& location) {
  ByteReader from(payload, location);
  TrajectoryProvenance provenance;
  provenance.spacetime = Spacetime{from.number<double>()};
  provenance.pixel = from.number<double>();
  provenance.budget_px = from.number<double>();
  const auto flags = from.number<std::uint32_t>();
  provenance.derivatives = (flags & flag_derivatives) != 0;
  provenance.disk = (flags & flag_disk) != 0;
  provenance.code_version = from.text();
  provenance.show_text = from.text();
  if (!(std::abs(provenance.spacetime.spin) <= 1.0 && provenance.pixel > 0.0 && provenance.budget_px > 0.0)) {
    throw Error(location, "is damaged (provenance)", "bake it again");
  }
  return provenance;
}

Bytes to_bytes(const Gap& gap) {
  ByteWriter to;
  to.number(gap.begin_s);
  to.number(gap.end_s);
  to.number(gap.error_px);
  to.number(gap.disk_error_px);
  return to.take();
}

Gap parse_gap(std::span<const std::byte> payload, const std::string& location) {
  ByteReader from(payload, location);
  const auto begin_s = from.number<double>();
  const auto end_s = from.number<double>();
  const auto error_px = from.number<float>();
  return {begin_s, end_s, error_px, from.number<float>()};
}

Bytes to_bytes(const std::vector<StationEntry>& index) {
  ByteWriter to;
  for (const StationEntry& entry : index) {
    to.number(entry.time_s);
    to.number(entry.r);
    to.number(entry.theta);
    to.number(entry.offset);
    to.number(entry.bytes);
    to.number(entry.gap_error_px);
    to.number(entry.nodes);
    to.number(entry.leaves);
    to.number(entry.disk_bytes);
    to.number(entry.disk_memory_bytes);
    to.number(entry.disk_gap_error_px);
  }
  return to.take();
}

std::vector<StationEntry> parse_index(std::span<const std::byte> payload, const std::string& location) {
  ByteReader from(payload, location);
  std::vector<StationEntry> index(payload.size() / entry_bytes);
  double before_s = -INFINITY;
  for (StationEntry& entry : index) {
    entry.time_s = from.number<double>();
    entry.r = from.number<double>();
    entry.theta = from.number<double>();
    entry.offset = from.number<std::uint64_t>();
    entry.bytes = from.number<std::uint64_t>();
    entry.gap_error_px = from.number<float>();
    entry.nodes = from.number<std::uint32_t>();
    entry.leaves = from.number<std::uint32_t>();
    entry.disk_bytes = from.number<std::uint32_t>();
    entry.disk_memory_bytes = from.number<std::uint32_t>();
    entry.disk_gap_error_px = from.number<float>();
    if (!(entry.time_s > before_s && std::isfinite(entry.time_s) && entry.r > 0.0 && entry.r < 1e9 &&
          std::isfinite(entry.theta))) {
      throw Error(location, "is damaged (index)", "bake it again");
    }
    before_s = entry.time_s;
  }
  return index;
}

}  // namespace ergodome
