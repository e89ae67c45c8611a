#include "content/trajectory/frame.h"

#include <fmt/format.h>
#include <xxhash.h>

#include <algorithm>
#include <memory>
#include <new>

namespace ergodome {

namespace {

//! First bytes of a trajectory file. The first byte is not text, and a transfer of the file as text
//! would change the line breaks.
constexpr unsigned char frame_magic[8] = {0x89, 'E', 'R', 'G', 'O', '\r', '\n', 0x1A};
constexpr std::size_t header_summed_bytes = trajectory_header_bytes - 8;
constexpr std::size_t frame_summed_bytes = frame_header_bytes - 8;

//! Returns the XXH3-64 of one or two consecutive pieces.
std::uint64_t checksum_of(std::span<const std::byte> first, std::span<const std::byte> second = {}) {
  const std::unique_ptr<XXH3_state_t, decltype(&XXH3_freeState)> state(XXH3_createState(), &XXH3_freeState);
  if (!state || XXH3_64bits_reset(state.get()) != XXH_OK) {
    throw std::bad_alloc();
  }
  XXH3_64bits_update(state.get(), first.data(), first.size());
  if (!second.empty()) {
    XXH3_64bits_update(state.get(), second.data(), second.size());
  }
  return XXH3_64bits_digest(state.get());
}

}  // namespace

Bytes to_bytes(const TrajectoryHeader& header) {
  ByteWriter to;
  to.append(std::as_bytes(std::span(frame_magic)));
  to.number(header.version);
  to.number(std::uint32_t{header.sealed ? 1U : 0U});
  to.number(header.file_bytes);
  to.number(header.index_offset);
  to.number(header.index_bytes);
  to.number(header.station_count);
  to.number(std::uint32_t{0});
  to.number(std::uint64_t{0});
  to.number(checksum_of(to.bytes()));
  return to.take();
}

TrajectoryHeader parse_trajectory_header(std::span<const std::byte> bytes, const std::string& location) {
  ByteReader from(bytes, location);
  const std::span<const std::byte> first = from.take(std::min(bytes.size(), sizeof frame_magic));
  if (!std::ranges::equal(first, std::as_bytes(std::span(frame_magic)))) {
    throw Error(location, "is not a trajectory", "create one with ergodome bake");
  }
  const auto version = from.number<std::uint32_t>();
  if (version > trajectory_version) {
    throw Error(
        location,
        fmt::format("is a trajectory of version {}, but this program reads version {}", version, trajectory_version),
        "bake it again, or use a newer Ergodome");
  }
  TrajectoryHeader header;
  header.version = version;
  const auto state = from.number<std::uint32_t>();
  header.sealed = state == 1;
  header.file_bytes = from.number<std::uint64_t>();
  header.index_offset = from.number<std::uint64_t>();
  header.index_bytes = from.number<std::uint64_t>();
  header.station_count = from.number<std::uint32_t>();
  from.take(12);
  if (from.number<std::uint64_t>() != checksum_of(bytes.first(header_summed_bytes)) || version == 0 || state > 1) {
    throw Error(location, "has a damaged header", "bake it again");
  }
  return header;
}

Bytes make_frame(FrameKind kind, std::uint32_t number, std::span<const std::byte> payload,
                 std::uint64_t unpacked_bytes) {
  ByteWriter to;
  to.number(static_cast<std::uint32_t>(kind));
  to.number(number);
  to.number(static_cast<std::uint64_t>(payload.size()));
  to.number(unpacked_bytes);
  to.number(checksum_of(to.bytes(), payload));
  to.append(payload);
  return to.take();
}

FrameHeader parse_frame_header(std::span<const std::byte> bytes, const std::string& location) {
  ByteReader from(bytes, location);
  FrameHeader header;
  header.kind = static_cast<FrameKind>(from.number<std::uint32_t>());
  header.number = from.number<std::uint32_t>();
  header.payload_bytes = from.number<std::uint64_t>();
  header.unpacked_bytes = from.number<std::uint64_t>();
  header.checksum = from.number<std::uint64_t>();
  if (header.payload_bytes > largest_frame_bytes || header.unpacked_bytes > largest_frame_bytes) {
    throw Error(location, "is damaged (impossible size)", "bake it again");
  }
  return header;
}

std::span<const std::byte> checked_payload(std::span<const std::byte> frame, FrameKind kind,
                                           const std::string& location) {
  const FrameHeader header = parse_frame_header(frame, location);
  const std::span<const std::byte> payload = frame.subspan(frame_header_bytes);
  if (header.kind != kind || header.payload_bytes != payload.size() ||
      header.checksum != checksum_of(frame.first(frame_summed_bytes), payload)) {
    throw Error(location, "is damaged (checksum)", "bake it again");
  }
  return payload;
}

}  // namespace ergodome
