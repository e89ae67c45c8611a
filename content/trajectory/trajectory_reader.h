#pragma once

#include <filesystem>
#include <vector>

#include "content/trajectory/data_file.h"
#include "content/trajectory/disk_station.h"
#include "content/trajectory/trajectory.h"

namespace ergodome {

//! Reads a finished trajectory file: the index is in memory, the stations stay on the disk and can
//! be read independently.
class TrajectoryReader {
 public:
  //! Opens a file and checks header, provenance and index. Throws Error with a remedy if it is
  //! truncated, damaged, of another format, of a newer version, or an unfinished bake.
  explicit TrajectoryReader(const std::filesystem::path& path);

  [[nodiscard]] const std::filesystem::path& path() const { return file_.path(); }
  [[nodiscard]] const TrajectoryProvenance& provenance() const { return provenance_; }
  [[nodiscard]] const std::vector<StationEntry>& stations() const { return stations_; }
  [[nodiscard]] std::uint64_t file_bytes() const { return file_bytes_; }

  //! Reads a station; safe to call from several threads. Throws Error, which names the station, if
  //! it is damaged.
  [[nodiscard]] LensStation read(std::size_t station) const;

  //! Reads the disk layers of a station that has them (StationEntry::disk_bytes).
  [[nodiscard]] DiskStation read_disk(std::size_t station) const;

 private:
  [[nodiscard]] Bytes frame_at(std::uint64_t offset, std::uint64_t bytes, const std::string& location) const;

  DataFile file_;
  TrajectoryProvenance provenance_;
  std::vector<StationEntry> stations_;
  std::uint64_t file_bytes_ = 0;
};

}  // namespace ergodome
