#include "app/pads/hid/hid_text.h"

#include <cstdint>
#include <type_traits>

namespace ergodome {

namespace {

constexpr std::size_t longest = 120;

void append_utf8(std::string& text, std::uint32_t point) {
  const auto byte = [&](std::uint32_t value) { text += static_cast<char>(static_cast<unsigned char>(value)); };
  if (point < 0x80U) {
    byte(point);
  } else if (point < 0x800U) {
    byte(0xC0U | (point >> 6U));
    byte(0x80U | (point & 0x3FU));
  } else if (point < 0x10000U) {
    byte(0xE0U | (point >> 12U));
    byte(0x80U | ((point >> 6U) & 0x3FU));
    byte(0x80U | (point & 0x3FU));
  } else {
    byte(0xF0U | (point >> 18U));
    byte(0x80U | ((point >> 12U) & 0x3FU));
    byte(0x80U | ((point >> 6U) & 0x3FU));
    byte(0x80U | (point & 0x3FU));
  }
}

bool is_shown(std::uint32_t point) {
  return point >= 0x20U && point != 0x7FU && !(point >= 0x80U && point < 0xA0U) &&
         !(point >= 0xD800U && point < 0xE000U) && point < 0x110000U;
}

std::string trimmed(const std::string& text) {
  const std::size_t first = text.find_first_not_of(' ');
  return first == std::string::npos ? "" : text.substr(first, text.find_last_not_of(' ') - first + 1);
}

}  // namespace

std::string text_of(const wchar_t* text) {
  std::string out;
  for (std::size_t i = 0; text != nullptr && i < longest && text[i] != L'\0'; ++i) {
    const auto point = std::uint32_t{static_cast<std::make_unsigned_t<wchar_t>>(text[i])};
    if (is_shown(point)) {
      append_utf8(out, point);
    }
  }
  return trimmed(out);
}

std::string without_controls(std::string_view text) {
  std::string out;
  for (const char c : text.substr(0, 4 * longest)) {
    if (static_cast<unsigned char>(c) >= 0x20U && c != 0x7F) {
      out += c;
    }
  }
  return trimmed(out);
}

}  // namespace ergodome
