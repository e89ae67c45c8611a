#pragma once

#include <string_view>

namespace ergodome {

//! Truncates a text to a number of bytes, without splitting a UTF-8 character.
inline std::string_view shortened(std::string_view text, std::size_t most_bytes) {
  if (text.size() <= most_bytes) {
    return text;
  }
  std::size_t end = most_bytes;
  while (end > 0 && (static_cast<unsigned char>(text[end]) & 0xC0U) == 0x80U) {
    --end;
  }
  return text.substr(0, end);
}

}  // namespace ergodome
