#include "content/trajectory/trajectory_journal.h"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fstream>

#include "content/files/atomic_file.h"
#include "content/trajectory/frame.h"
#include "content/trajectory/station_frame.h"

namespace ergodome {

namespace {

void write(std::ofstream& file, std::span<const std::byte> bytes) {
  file.write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
}

}  // namespace

TrajectoryJournal::TrajectoryJournal(const std::filesystem::path& path, const TrajectoryProvenance& provenance)
    : file_(DataFile::open_locked(path)), provenance_(provenance) {
  scan();
}

void TrajectoryJournal::scan() {
  const std::string name = file_.path().string();
  Bytes expected = to_bytes(TrajectoryHeader{});
  const Bytes head = make_frame(FrameKind::provenance, to_bytes(provenance_));
  expected.insert(expected.end(), head.begin(), head.end());
  const std::uint64_t end = file_.size();
  const Bytes found = file_.read(0, std::min<std::uint64_t>(end, expected.size()), name);
  if (!std::equal(found.begin(), found.end(), expected.begin())) {
    throw Error(name, "is not the journal of this bake (another show, budget or version, or no journal)",
                "remove it, or choose another file with --out");
  }
  if (found.size() < expected.size()) {
    // Not even its beginning came to the disk.
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
  const std::string place = fmt::format("{}: byte {}", file_.path().string(), offset);
  if (end - offset < frame_header_bytes) {
    return false;
  }
  try {
    const FrameHeader header = parse_frame_header(file_.read(offset, frame_header_bytes, place), place);
    const std::uint64_t bytes = frame_header_bytes + header.payload_bytes;
    if (bytes > end - offset) {
      return false;
    }
    const Bytes frame = file_.read(offset, bytes, place);
    if (header.kind == FrameKind::gap) {
      const Gap gap = parse_gap(checked_payload(frame, FrameKind::gap, place), place);
      gaps_.try_emplace({gap.begin_s, gap.end_s}, gap.error_px);
    } else {
      stations_.try_emplace(parse_summary(frame, place).time_s, Place{offset, bytes});
    }
    next = offset + bytes;
    return true;
  } catch (const Error&) {
    return false;  // what was in flight when the bake was killed
  }
}

Bytes TrajectoryJournal::frame_at(double time_s) const {
  const Place& place = stations_.at(time_s);
  return file_.read(place.offset, place.bytes, file_.path().string());
}

LensStation TrajectoryJournal::read(double time_s) const {
  return parse_station(frame_at(time_s), fmt::format("{}: station at {} s", file_.path().string(), time_s));
}

void TrajectoryJournal::add(double time_s, const LensStation& station) {
  const Bytes frame = make_station_frame(0, time_s, station);
  const std::uint64_t offset = file_.size();
  file_.append(frame);
  stations_.try_emplace(time_s, Place{offset, frame.size()});
}

const float* TrajectoryJournal::find_gap(double begin_s, double end_s) const {
  const auto found = gaps_.find({begin_s, end_s});
  return found != gaps_.end() ? &found->second : nullptr;
}

void TrajectoryJournal::add(const Gap& gap) {
  file_.append(make_frame(FrameKind::gap, to_bytes(gap)));
  gaps_.try_emplace({gap.begin_s, gap.end_s}, gap.error_px);
}

void TrajectoryJournal::absorb(const TrajectoryJournal& other) {
  for (const auto& [time_s, place] : other.stations_) {
    if (!has_station(time_s)) {
      const std::uint64_t offset = file_.size();
      file_.append(other.frame_at(time_s));
      stations_.try_emplace(time_s, Place{offset, place.bytes});
    }
  }
  for (const auto& [ends_s, error_px] : other.gaps_) {
    if (!gaps_.contains(ends_s)) {
      add(Gap{ends_s.first, ends_s.second, error_px});
    }
  }
}

void TrajectoryJournal::seal(const std::filesystem::path& path, const std::vector<double>& times_s) const {
  write_atomically(path, [&](const std::filesystem::path& partial) {
    std::ofstream file(partial, std::ios::binary);
    write(file, to_bytes(TrajectoryHeader{}));
    const Bytes head = make_frame(FrameKind::provenance, to_bytes(provenance_));
    write(file, head);
    std::uint64_t offset = trajectory_header_bytes + head.size();
    std::vector<StationEntry> index;
    for (std::size_t i = 0; i < times_s.size() && file; ++i) {
      const std::string place = fmt::format("{}: station at {} s", file_.path().string(), times_s[i]);
      const Bytes frame = renumbered(frame_at(times_s[i]), static_cast<std::uint32_t>(i), place);
      const StationSummary summary = parse_summary(frame, place);
      const float* gap = i + 1 < times_s.size() ? find_gap(times_s[i], times_s[i + 1]) : nullptr;
      index.push_back({times_s[i], summary.r, summary.theta, offset, frame.size(), gap != nullptr ? *gap : -1.0F,
                       summary.nodes, summary.leaves});
      write(file, frame);
      offset += frame.size();
    }
    const Bytes last = make_frame(FrameKind::index, to_bytes(index));
    write(file, last);
    file.seekp(0);
    write(file, to_bytes(TrajectoryHeader{true, offset + last.size(), offset, last.size(),
                                          static_cast<std::uint32_t>(index.size())}));
    file.close();
    if (!file) {
      throw Error(path.string(), std::string("cannot be written: ") + std::strerror(errno),
                  "free some space; what is baked is kept, and baking goes on from it");
    }
  });
}

}  // namespace ergodome
