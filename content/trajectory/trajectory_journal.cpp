#include "content/trajectory/trajectory_journal.h"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fstream>

#include "content/files/atomic_file.h"
#include "content/trajectory/frame.h"
#include "content/trajectory/station_codec.h"
#include "kernels/spacetime/kerr/kerr.h"

namespace ergodome {

namespace {

//! A file that is written sequentially.
struct GrowingFile {
  std::ofstream file;
  std::uint64_t bytes = 0;

  void write(std::span<const std::byte> more) {
    file.write(reinterpret_cast<const char*>(more.data()), static_cast<std::streamsize>(more.size()));
    bytes += more.size();
  }
};

}  // namespace

TrajectoryJournal::TrajectoryJournal(const std::filesystem::path& path, const TrajectoryProvenance& provenance)
    : TrajectoryJournal(DataFile::open_locked(path), provenance) {}

TrajectoryJournal::TrajectoryJournal(DataFile file, const TrajectoryProvenance& provenance)
    : file_(std::move(file)), provenance_(provenance) {
  scan();
}

std::optional<TrajectoryJournal> TrajectoryJournal::try_open(const std::filesystem::path& path,
                                                             const TrajectoryProvenance& provenance) {
  std::optional<DataFile> file = DataFile::try_open_locked(path);
  return file ? std::optional(TrajectoryJournal(std::move(*file), provenance)) : std::nullopt;
}

void TrajectoryJournal::scan() {
  const std::string name = file_.path().string();
  Bytes expected = to_bytes(TrajectoryHeader{});
  const Bytes head = make_frame(FrameKind::provenance, to_bytes(provenance_));
  expected.insert(expected.end(), head.begin(), head.end());
  const std::uint64_t end = file_.size();
  const Bytes found = file_.read(0, std::min<std::uint64_t>(end, expected.size()), name);
  if (!std::equal(found.begin(), found.end(), expected.begin())) {
    throw Error(
        name, "was not written by this bake: it belongs to another show, budget or version, or is another kind of file",
        "remove it, or choose another --out");
  }
  if (found.size() < expected.size()) {
    // The file does not even contain the whole header, so it is begun again.
    file_.cut(0);
    file_.append(expected);
    return;
  }
  std::uint64_t next = expected.size();
  while (take_frame(next, end, next)) {
  }
  if (next < end) {
    file_.cut(next);
  }
}

bool TrajectoryJournal::take_frame(std::uint64_t offset, std::uint64_t end, std::uint64_t& next) {
  const std::string location = fmt::format("{}: byte {}", file_.path().string(), offset);
  if (end - offset < frame_header_bytes) {
    return false;
  }
  try {
    const FrameHeader header = parse_frame_header(file_.read(offset, frame_header_bytes, location), location);
    const std::uint64_t bytes = frame_header_bytes + header.payload_bytes;
    if (bytes > end - offset) {
      return false;
    }
    const Bytes frame = file_.read(offset, bytes, location);
    if (header.kind == FrameKind::gap) {
      const Gap gap = parse_gap(checked_payload(frame, FrameKind::gap, location), location);
      gaps_.try_emplace({gap.begin_s, gap.end_s}, gap);
    } else if (header.kind == FrameKind::disk) {
      disks_.try_emplace(parse_disk_time(frame, location), FileRange{offset, bytes});
    } else {
      stations_.try_emplace(parse_summary(frame, location).time_s, FileRange{offset, bytes});
    }
    next = offset + bytes;
    return true;
  } catch (const Error&) {
    return false;  // this is the frame that an interrupted bake was writing
  }
}

std::string TrajectoryJournal::station_name(double time_s) const {
  return fmt::format("{}: station at {} s", file_.path().string(), time_s);
}

Bytes TrajectoryJournal::frame_at(const FileRange& position) const {
  return file_.read(position.offset, position.bytes, file_.path().string());
}

LensStation TrajectoryJournal::read(double time_s) const {
  return parse_station(frame_at(stations_.at(time_s)), station_name(time_s));
}

DiskStation TrajectoryJournal::read_disk(double time_s) const {
  return parse_disk(frame_at(disks_.at(time_s)), station_name(time_s));
}

void TrajectoryJournal::append_to(FileRanges& ranges, double time_s, const Bytes& frame) {
  const std::uint64_t offset = file_.size();
  file_.append(frame);
  ranges.try_emplace(time_s, FileRange{offset, frame.size()});
}

void TrajectoryJournal::add(double time_s, const LensStation& station) {
  append_to(stations_, time_s, make_station_frame(0, time_s, station));
}

void TrajectoryJournal::add(double time_s, const DiskStation& disk) {
  append_to(disks_, time_s, make_disk_frame(0, time_s, disk));
}

const Gap* TrajectoryJournal::find_gap(double begin_s, double end_s) const {
  const auto found = gaps_.find({begin_s, end_s});
  return found != gaps_.end() ? &found->second : nullptr;
}

void TrajectoryJournal::add(const Gap& gap) {
  file_.append(make_frame(FrameKind::gap, to_bytes(gap)));
  gaps_.try_emplace({gap.begin_s, gap.end_s}, gap);
}

void TrajectoryJournal::absorb(const TrajectoryJournal& other) {
  const auto take = [&](const FileRanges& from, FileRanges& to) {
    for (const auto& [time_s, location] : from) {
      if (!to.contains(time_s)) {
        append_to(to, time_s, other.frame_at(location));
      }
    }
  };
  take(other.stations_, stations_);
  take(other.disks_, disks_);
  for (const auto& [ends_s, gap] : other.gaps_) {
    if (!gaps_.contains(ends_s)) {
      add(gap);
    }
  }
}

StationEntry TrajectoryJournal::entry_at(double time_s, const double* next_s) const {
  const std::string location = station_name(time_s);
  const Bytes frame = frame_at(stations_.at(time_s));
  const StationSummary summary = parse_summary(frame, location);
  StationEntry entry;
  entry.time_s = time_s;
  entry.r = summary.r;
  entry.theta = summary.theta;
  entry.bytes = frame.size();
  entry.nodes = summary.nodes;
  entry.leaves = summary.leaves;
  if (const Gap* gap = next_s != nullptr ? find_gap(time_s, *next_s) : nullptr) {
    entry.gap_error_px = gap->error_px;
    entry.disk_gap_error_px = gap->disk_error_px;
  }
  if (const auto disk = disks_.find(time_s); disk != disks_.end()) {
    const Bytes layers = frame_at(disk->second);
    entry.disk_bytes = static_cast<std::uint32_t>(layers.size());
    entry.disk_memory_bytes = static_cast<std::uint32_t>(parse_frame_header(layers, location).unpacked_bytes);
  }
  return entry;
}

void TrajectoryJournal::seal(const std::filesystem::path& path, const std::vector<double>& times_s) const {
  write_atomically(path, [&](const std::filesystem::path& partial) {
    GrowingFile to{std::ofstream(partial, std::ios::binary)};
    to.write(to_bytes(TrajectoryHeader{}));
    to.write(make_frame(FrameKind::provenance, to_bytes(provenance_)));
    std::vector<StationEntry> index;
    for (std::size_t i = 0; i < times_s.size() && to.file; ++i) {
      StationEntry& entry =
          index.emplace_back(entry_at(times_s[i], i + 1 < times_s.size() ? &times_s[i + 1] : nullptr));
      entry.offset = to.bytes;
      for (const FileRanges* ranges : {&stations_, &disks_}) {
        if (const auto found = ranges->find(times_s[i]); found != ranges->end()) {
          to.write(renumbered(frame_at(found->second), static_cast<std::uint32_t>(i), station_name(times_s[i])));
        }
      }
    }
    const std::uint64_t index_offset = to.bytes;
    to.write(make_frame(FrameKind::index, to_bytes(index)));
    const std::uint64_t whole = to.bytes;
    to.file.seekp(0);
    const bool within = std::ranges::any_of(
        index, [&](const StationEntry& entry) { return !(entry.r > horizon_radius(provenance_.spacetime)); });
    to.write(to_bytes(TrajectoryHeader{true, whole, index_offset, whole - index_offset,
                                       static_cast<std::uint32_t>(index.size()),
                                       within ? trajectory_version : outside_version}));
    to.file.close();
    if (!to.file) {
      throw Error(path.string(), std::string("cannot be written: ") + std::strerror(errno),
                  "free some space and run the bake again: it continues from what is saved");
    }
  });
}

}  // namespace ergodome
