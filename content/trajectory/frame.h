#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "content/files/bytes.h"

namespace ergodome {

// The outer layers of a trajectory file: its header and its frames.
// content/docs/reference/trajectory-file.md describes every byte.

inline constexpr std::uint32_t trajectory_version = 2;
//! Version of files whose stations are all outside the horizon; older programs can read these.
inline constexpr std::uint32_t outside_version = 1;
inline constexpr std::size_t trajectory_header_bytes = 64;
inline constexpr std::size_t frame_header_bytes = 32;
//! Maximum size of a frame, compressed and uncompressed; it limits what a reader allocates for a
//! damaged size.
inline constexpr std::uint64_t largest_frame_bytes = std::uint64_t{1} << 28;

//! Returns four letters as a number, the first in the lowest byte.
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

//! The header of a trajectory file.
struct TrajectoryHeader {
  bool sealed = false;             //!< false: the journal of a bake, without an index
  std::uint64_t file_bytes = 0;    //!< size of the file; set only in a sealed file
  std::uint64_t index_offset = 0;  //!< offset of the index; set only in a sealed file
  std::uint64_t index_bytes = 0;   //!< size of the index, including its frame header
  std::uint32_t station_count = 0;
  std::uint32_t version = outside_version;
};

struct FrameHeader {
  FrameKind kind;
  std::uint32_t number;         //!< index of a station, also for its disk layers; 0 in journals and other frames
  std::uint64_t payload_bytes;  //!< size of the payload as stored in the file
  //! Size of the payload after decompression; equals payload_bytes if it is not compressed.
  std::uint64_t unpacked_bytes;
  std::uint64_t checksum;
};

Bytes to_bytes(const TrajectoryHeader& header);

//! Parses the header of a trajectory file. Throws Error if the file is damaged, of another format,
//! or of a newer version.
TrajectoryHeader parse_trajectory_header(std::span<const std::byte> bytes, const std::string& location);

//! Returns a complete frame with its header and checksum.
Bytes make_frame(FrameKind kind, std::uint32_t number, std::span<const std::byte> payload,
                 std::uint64_t unpacked_bytes);
inline Bytes make_frame(FrameKind kind, std::span<const std::byte> payload) {
  return make_frame(kind, 0, payload, payload.size());
}

//! Parses a frame header. Throws Error if its sizes are impossible; does not verify the checksum.
FrameHeader parse_frame_header(std::span<const std::byte> bytes, const std::string& location);

//! Returns the payload of a complete frame. Throws Error unless the frame has this kind, exactly
//! the length that its header states, and a correct checksum.
std::span<const std::byte> checked_payload(std::span<const std::byte> frame, FrameKind kind,
                                           const std::string& location);

}  // namespace ergodome
