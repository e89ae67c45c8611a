#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "content/trajectory/bytes.h"
#include "content/trajectory/lens_station.h"
#include "kernels/spacetime/kerr/observer.h"

namespace ergodome {

//! What a trajectory was baked from and for. Two bakes with the same provenance make the same stations.
struct TrajectoryProvenance {
  std::string code_version;
  std::string show_text;  //!< the show, as TOML
  double spin = 0.0;
  double pixel = 0.0;        //!< angle of a pixel on the screen [rad]
  double budget_px = 0.0;    //!< displacement on the screen
  bool derivatives = false;  //!< stations hold their change along r and θ
  bool disk = false;         //!< stations hold the layers of the show's disk

  bool operator==(const TrajectoryProvenance&) const = default;
};

//! A station, as the index of a trajectory has it.
struct StationEntry {
  double time_s = 0.0;       //!< when the show's camera is there
  double r = 0.0;            //!< [M]
  double theta = 0.0;        //!< [rad]
  std::uint64_t offset = 0;  //!< of its frame in the file
  std::uint64_t bytes = 0;   //!< of its frame
  //! What blending it with the next station misses by on the screen, the worse of a quarter of the way and half of it: for all but a
  //! hundredth of the sky, or a fifth of that for all but a thousandth, whichever is more [px]. 0 where the camera stands still, -1 after
  //! the last station.
  float gap_error_px = -1.0F;
  std::uint32_t nodes = 0;
  std::uint32_t leaves = 0;
  std::uint32_t disk_bytes = 0;         //!< of the frame of its disk layers, which follows; 0: it has none
  std::uint32_t disk_memory_bytes = 0;  //!< of these once unpacked
  float disk_gap_error_px = 0.0F;       //!< as gap_error_px, of the disk alone and of what shows the disk
};

//! The stretch between two stations, found good enough (or as good as it can be made) for blending.
struct Gap {
  double begin_s = 0.0;
  double end_s = 0.0;
  float error_px = 0.0F;
  float disk_error_px = 0.0F;  //!< of the disk's layers
};

//! What the gaps between stations miss that stay over a limit.
struct MissedGaps {
  int count = 0;
  double seconds = 0.0;       //!< all of them together
  double worst_px = 0.0;      //!< error of the worst
  double worst_time_s = 0.0;  //!< in the middle of that gap
};

//! Gaps of a finished trajectory whose StationEntry::gap_error_px is over `limit_px`. Disks' errors are none of them: where these are too much a grid
//! is made anew.
MissedGaps missed_gaps(const std::vector<StationEntry>& stations, double limit_px);

//! How messages call a station of a trajectory file.
std::string station_place(const std::filesystem::path& file, std::size_t station);

Bytes to_bytes(const TrajectoryProvenance& provenance);
TrajectoryProvenance parse_provenance(std::span<const std::byte> payload, const std::string& place);

Bytes to_bytes(const Gap& gap);
Gap parse_gap(std::span<const std::byte> payload, const std::string& place);

Bytes to_bytes(const std::vector<StationEntry>& index);
std::vector<StationEntry> parse_index(std::span<const std::byte> payload, const std::string& place);

}  // namespace ergodome
