#pragma once

#include <map>
#include <optional>
#include <utility>
#include <vector>

#include "content/trajectory/data_file.h"
#include "content/trajectory/disk_station.h"
#include "content/trajectory/trajectory.h"

namespace ergodome {

//! The journal of an unfinished bake: stations and gaps in the order of their computation, each
//! flushed to the disk before the next one begins. After an interruption only the unfinished entry
//! is lost, and the bake can resume.
class TrajectoryJournal {
 public:
  //! Opens or creates a journal, and removes a truncated or damaged frame and all that follows it.
  //! Throws Error if another process uses the journal, or if it belongs to another bake.
  TrajectoryJournal(const std::filesystem::path& path, const TrajectoryProvenance& provenance);

  //! Opens or creates a journal like the constructor, but returns nothing if another process uses
  //! it.
  static std::optional<TrajectoryJournal> try_open(const std::filesystem::path& path,
                                                   const TrajectoryProvenance& provenance);

  [[nodiscard]] bool has_station(double time_s) const { return stations_.contains(time_s); }
  [[nodiscard]] std::size_t station_count() const { return stations_.size(); }

  //! Reads the station at this show time, which must exist.
  [[nodiscard]] LensStation read(double time_s) const;
  void add(double time_s, const LensStation& station);

  //! has_disk() and read_disk() do the same as has_station() and read(), for a station's disk
  //! layers.
  [[nodiscard]] bool has_disk(double time_s) const { return disks_.contains(time_s); }
  [[nodiscard]] DiskStation read_disk(double time_s) const;
  void add(double time_s, const DiskStation& disk);

  //! Returns the accepted gap between these show times, or nullptr if there is none.
  [[nodiscard]] const Gap* find_gap(double begin_s, double end_s) const;
  void add(const Gap& gap);

  //! Adds the entries of another journal of the same bake that are missing here.
  void absorb(const TrajectoryJournal& other);

  //! Writes the finished file atomically: the stations of these times, in order, each followed by
  //! its disk layers, and an index with the errors of the gaps between them.
  void seal(const std::filesystem::path& path, const std::vector<double>& times_s) const;

 private:
  struct FileRange {
    std::uint64_t offset;
    std::uint64_t bytes;
  };
  using FileRanges = std::map<double, FileRange>;

  TrajectoryJournal(DataFile file, const TrajectoryProvenance& provenance);
  void scan();
  bool take_frame(std::uint64_t offset, std::uint64_t end, std::uint64_t& next);
  [[nodiscard]] std::string station_name(double time_s) const;
  [[nodiscard]] Bytes frame_at(const FileRange& position) const;
  [[nodiscard]] StationEntry entry_at(double time_s, const double* next_s) const;
  void append_to(FileRanges& ranges, double time_s, const Bytes& frame);

  DataFile file_;
  TrajectoryProvenance provenance_;
  FileRanges stations_;
  FileRanges disks_;
  std::map<std::pair<double, double>, Gap> gaps_;
};

}  // namespace ergodome
