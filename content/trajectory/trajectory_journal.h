#pragma once

#include <map>
#include <utility>
#include <vector>

#include "content/trajectory/data_file.h"
#include "content/trajectory/disk_station.h"
#include "content/trajectory/trajectory.h"

namespace ergodome {

//! A bake on its way: stations and gaps in the order in which they were found, each down on the disk before the next is begun. A kill
//! loses what was in flight alone; opening it again goes on from there.
class TrajectoryJournal {
 public:
  //! Opens or begins a journal, and takes away a frame at its end that was cut off. Throws Error where another process has it, or where it
  //! belongs to another bake.
  TrajectoryJournal(const std::filesystem::path& path, const TrajectoryProvenance& provenance);

  [[nodiscard]] bool has_station(double time_s) const { return stations_.contains(time_s); }
  [[nodiscard]] std::size_t station_count() const { return stations_.size(); }

  //! A station that is there.
  [[nodiscard]] LensStation read(double time_s) const;
  void add(double time_s, const LensStation& station);

  //! The same for a station's disk layers.
  [[nodiscard]] bool has_disk(double time_s) const { return disks_.contains(time_s); }
  [[nodiscard]] DiskStation read_disk(double time_s) const;
  void add(double time_s, const DiskStation& disk);

  //! A gap that was found good, or a null pointer.
  [[nodiscard]] const Gap* find_gap(double begin_s, double end_s) const;
  void add(const Gap& gap);

  //! Takes over what another journal of the same bake has and this one has not.
  void absorb(const TrajectoryJournal& other);

  //! Writes the finished file: the stations of these times, in order, each followed by its disk layers, and the gaps between them. Whole or not at all.
  void seal(const std::filesystem::path& path, const std::vector<double>& times_s) const;

 private:
  struct Place {
    std::uint64_t offset;
    std::uint64_t bytes;
  };
  using Places = std::map<double, Place>;

  void scan();
  bool take_frame(std::uint64_t offset, std::uint64_t end, std::uint64_t& next);
  [[nodiscard]] std::string station_name(double time_s) const;
  [[nodiscard]] Bytes frame_at(const Place& place) const;
  [[nodiscard]] StationEntry entry_at(double time_s, const double* next_s) const;
  void append_to(Places& places, double time_s, const Bytes& frame);

  DataFile file_;
  TrajectoryProvenance provenance_;
  Places stations_;
  Places disks_;
  std::map<std::pair<double, double>, Gap> gaps_;
};

}  // namespace ergodome
