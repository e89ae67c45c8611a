#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "app/cluster/cluster_messages.h"

// Converts messages of a cluster to bytes and back.
//
// A message begins with the letters "ED", the version of the format and the kind of the message.
// Its members follow in the order of their declaration: numbers with the lowest byte first, texts
// after their length in two bytes, optional members after a byte 0 or 1.

namespace ergodome {

//! Version of the format. Computers with different versions do not understand each other.
inline constexpr std::uint8_t cluster_format = 1;

//! Returns the bytes of a message, at most max_cluster_message.
std::vector<std::byte> encode_cluster(const ClusterMessage& message);

//! Returns the message in untrusted bytes. Returns nothing for an unknown version or kind, for
//! missing or additional bytes, and for values that no renderer accepts: non-finite numbers, unknown
//! choices, speeds that are not below that of light.
std::optional<ClusterMessage> decode_cluster(std::span<const std::byte> bytes);

}  // namespace ergodome
