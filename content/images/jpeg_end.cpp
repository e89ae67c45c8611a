#include "content/images/jpeg_end.h"

#include <cstddef>

namespace ergodome {

namespace {

constexpr unsigned end_of_image = 0xD9;

//! Markers without a length behind them: the start, restarts, what a program may use for itself, and 0 behind a 255 that is no marker.
bool stands_alone(unsigned marker) { return marker <= 0x01 || (marker >= 0xD0 && marker <= 0xD8); }

}  // namespace

bool has_jpeg_end(std::string_view bytes) {
  const auto byte = [&](std::size_t at) { return static_cast<unsigned>(static_cast<unsigned char>(bytes[at])); };
  std::size_t at = 0;
  while ((at = bytes.find('\xFF', at)) < bytes.size() && at + 1 < bytes.size()) {
    const unsigned marker = byte(at + 1);
    if (marker == end_of_image) {
      return true;
    }
    if (marker == 0xFF) {
      at += 1;
    } else if (stands_alone(marker)) {
      at += 2;
    } else if (at + 3 < bytes.size()) {
      at += 2 + 256 * byte(at + 2) + byte(at + 3);
    } else {
      return false;
    }
  }
  return false;
}

}  // namespace ergodome
