#pragma once

#include <filesystem>
#include <vector>

#include "content/trajectory/data_file.h"
#include "content/trajectory/disk_station.h"
#include "content/trajectory/trajectory.h"

namespace ergodome {

//! A finished trajectory file: its index in memory, its stations on the disk, each to be read without the others.
class TrajectoryReader {
 public:
  //! Opens and checks header, provenance and index. Throws Error with the remedy for files that are cut off, damaged, foreign, newer, or
  //! a bake that is not finished.
  explicit TrajectoryReader(const std::filesystem::path& path);

  [[nodiscard]] const std::filesystem::path& path() const { return file_.path(); }
  [[nodiscard]] const TrajectoryProvenance& provenance() const { return provenance_; }
  [[nodiscard]] const std::vector<StationEntry>& stations() const { return stations_; }
  [[nodiscard]] std::uint64_t file_bytes() const { return file_bytes_; }

  //! Reads one station; any number of threads may. Throws Error naming the station where it is damaged.
  [[nodiscard]] LensStation read(std::size_t station) const;

  //! The same for a station's disk layers, of one that has them (StationEntry::disk_bytes).
  [[nodiscard]] DiskStation read_disk(std::size_t station) const;

 private:
  [[nodiscard]] Bytes frame_at(std::uint64_t offset, std::uint64_t bytes, const std::string& place) const;

  DataFile file_;
  TrajectoryProvenance provenance_;
  std::vector<StationEntry> stations_;
  std::uint64_t file_bytes_ = 0;
};

}  // namespace ergodome
