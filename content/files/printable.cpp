#include "content/files/printable.h"

#include <fmt/format.h>

namespace ergodome {

std::string printable(std::string_view text) {
  std::string shown;
  for (const char c : text) {
    const bool control = static_cast<unsigned char>(c) < 0x20U || c == '\x7F';
    shown += control ? fmt::format("\\x{:02X}", static_cast<unsigned char>(c)) : std::string(1, c);
  }
  return shown;
}

}  // namespace ergodome
