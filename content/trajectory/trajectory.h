#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "content/files/bytes.h"
#include "content/trajectory/lens_station.h"
#include "kernels/spacetime/kerr/observer.h"

namespace ergodome {

//! The inputs of a bake. Two bakes with the same provenance produce the same stations.
struct TrajectoryProvenance {
  std::string code_version;
  std::string show_text;  //!< the show as TOML
  Spacetime spacetime;
  double pixel = 0.0;        //!< angle that a pixel of the screen subtends [rad]
  double budget_px = 0.0;    //!< accepted displacement of directions on the screen
  bool derivatives = false;  //!< stations contain derivatives with respect to the camera's r and θ
  bool disk = false;         //!< stations contain layers of the show's disk

  bool operator==(const TrajectoryProvenance&) const = default;
};

//! Index entry of a station.
struct StationEntry {
  double time_s = 0.0;       //!< show time of the camera at this position
  double r = 0.0;            //!< camera's Boyer-Lindquist radius [M]
  double theta = 0.0;        //!< camera's polar angle [rad]
  std::uint64_t offset = 0;  //!< offset of the station's frame in the file
  std::uint64_t bytes = 0;   //!< size of the station's frame
  //! Error on the screen if this station and the next one are blended: the larger of the errors at
  //! a quarter and at half of the way between them [px]. The error at one point is the larger of
  //! two values: the error that 1% of the sky exceeds, and a fifth of the error that 0.1% of the
  //! sky exceeds. 0 if the camera does not move, -1 for the last station.
  float gap_error_px = -1.0F;
  std::uint32_t nodes = 0;
  std::uint32_t leaves = 0;
  //! Size of the frame with its disk layers, which follows the station's frame; 0 without disk
  //! layers.
  std::uint32_t disk_bytes = 0;
  std::uint32_t disk_memory_bytes = 0;  //!< size of the disk layers after decompression
  //! Like gap_error_px, for the disk's layers; 0 without layers, 1e30 if they cannot be blended.
  float disk_gap_error_px = 0.0F;
};

//! An accepted interval between two stations: blending them is accurate enough, or division would
//! not make it more accurate.
struct Gap {
  double begin_s = 0.0;
  double end_s = 0.0;
  float error_px = 0.0F;
  float disk_error_px = 0.0F;  //!< blending error of the disk layers
};

//! Summary of the gaps whose blending error exceeds a limit.
struct MissedGaps {
  int count = 0;
  double seconds = 0.0;       //!< total duration
  double worst_px = 0.0;      //!< largest blending error [px]
  double worst_time_s = 0.0;  //!< show time in the middle of the gap with the largest error
};

//! Summarizes the gaps of a finished trajectory whose StationEntry::gap_error_px exceeds
//! `limit_px`. Ignores errors of disks, because grids are recomputed where these are too large.
MissedGaps missed_gaps(const std::vector<StationEntry>& stations, double limit_px);

//! Returns the name of a station for messages: "FILE: station 3" for index 2.
std::string station_position(const std::filesystem::path& file, std::size_t station);

Bytes to_bytes(const TrajectoryProvenance& provenance);
TrajectoryProvenance parse_provenance(std::span<const std::byte> payload, const std::string& location);

Bytes to_bytes(const Gap& gap);
Gap parse_gap(std::span<const std::byte> payload, const std::string& location);

Bytes to_bytes(const std::vector<StationEntry>& index);
std::vector<StationEntry> parse_index(std::span<const std::byte> payload, const std::string& location);

}  // namespace ergodome
