#include "content/files/bytes.h"

#include <algorithm>
#include <cstddef>

namespace ergodome {

void ByteWriter::append(std::span<const std::byte> raw) {
  const std::size_t before = bytes_.size();
  bytes_.resize(before + raw.size());
  std::ranges::copy(raw, bytes_.begin() + static_cast<std::ptrdiff_t>(before));
}

}  // namespace ergodome
