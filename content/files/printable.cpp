#include "content/files/printable.h"

#include <fmt/format.h>

namespace ergodome {

namespace {

//! Returns the size of the control character at `at` [bytes]; 0 if it is another character. C1
//! characters have two bytes, C2 80 to C2 9F.
std::size_t control_size(std::string_view text, std::size_t at) {
  const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
  if (byte(at) < 0x20U || byte(at) == 0x7FU) {
    return 1;
  }
  return byte(at) == 0xC2U && at + 1 < text.size() && byte(at + 1) >= 0x80U && byte(at + 1) < 0xA0U ? 2 : 0;
}

}  // namespace

std::size_t find_control(std::string_view text) {
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] != '\n' && control_size(text, i) > 0) {
      return i;
    }
  }
  return std::string_view::npos;
}

std::string printable(std::string_view text) {
  std::string shown;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const std::size_t size = control_size(text, i);
    if (size == 0) {
      shown += text[i];
    } else {
      i += size - 1;
      shown += fmt::format("\\x{:02X}", static_cast<unsigned char>(text[i]));
    }
  }
  return shown;
}

}  // namespace ergodome
