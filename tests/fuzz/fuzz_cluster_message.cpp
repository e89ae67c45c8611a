#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>

#include "app/cluster/cluster_codec.h"

// Any bytes are either refused or a message with exactly these bytes.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::span<const std::byte> bytes = std::as_bytes(std::span(data, size));
  if (const auto message = ergodome::decode_cluster(bytes)) {
    if (!std::ranges::equal(ergodome::encode_cluster(*message), bytes)) {
      __builtin_trap();
    }
  }
  return 0;
}
