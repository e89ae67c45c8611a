#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "content/trajectory/bytes.h"

namespace ergodome {

// The outer layers of a trajectory file: its header, and frames. content/docs/reference/trajectory-file.md describes it byte by byte.

inline constexpr std::uint32_t trajectory_version = 2;
//! Of files all of whose stations are outside the horizon: programs that know of none within read these.
inline constexpr std::uint32_t outside_version = 1;
inline constexpr std::size_t trajectory_header_bytes = 64;
inline constexpr std::size_t frame_header_bytes = 32;
//! No frame is larger, packed or unpacked: what a damaged size may make a reader allocate.
inline constexpr std::uint64_t largest_frame_bytes = std::uint64_t{1} << 28;

//! Four letters, the first in the lowest byte.
constexpr std::uint32_t letters(const char (&text)[5]) {
  std::uint32_t code = 0;
  for (int i = 3; i >= 0; --i) {
    code = code << 8 | static_cast<unsigned char>(text[i]);
  }
  return code;
}

enum class FrameKind : std::uint32_t {
  provenance = letters("PROV"),
  station = letters("STAT"),
  disk = letters("DISK"),
  gap = letters("GAP "),
  index = letters("INDX")
};

//! What stands in the first bytes of a trajectory.
struct TrajectoryHeader {
  bool sealed = false;             //!< false: a bake's journal, without an index
  std::uint64_t file_bytes = 0;    //!< of a sealed file
  std::uint64_t index_offset = 0;  //!< of a sealed file
  std::uint64_t index_bytes = 0;   //!< with its frame header
  std::uint32_t station_count = 0;
  std::uint32_t version = outside_version;
};

struct FrameHeader {
  FrameKind kind;
  std::uint32_t number;          //!< of the station, also that of disk layers; 0 in other frames
  std::uint64_t payload_bytes;   //!< in the file
  std::uint64_t unpacked_bytes;  //!< once decompressed; payload_bytes where nothing is compressed
  std::uint64_t checksum;
};

Bytes to_bytes(const TrajectoryHeader& header);

//! Throws Error for files that are no trajectory, damaged, or of a newer version.
TrajectoryHeader parse_trajectory_header(std::span<const std::byte> bytes, const std::string& place);

//! A frame with its header and checksum, ready to be written.
Bytes make_frame(FrameKind kind, std::uint32_t number, std::span<const std::byte> payload,
                 std::uint64_t unpacked_bytes);
inline Bytes make_frame(FrameKind kind, std::span<const std::byte> payload) {
  return make_frame(kind, 0, payload, payload.size());
}

//! Throws Error where the sizes cannot be; the checksum is not looked at yet.
FrameHeader parse_frame_header(std::span<const std::byte> bytes, const std::string& place);

//! The payload of a whole frame. Throws Error unless it is a frame of that kind, of just this length, with a right checksum.
std::span<const std::byte> checked_payload(std::span<const std::byte> frame, FrameKind kind, const std::string& place);

}  // namespace ergodome
