#pragma once

#include <string>
#include <string_view>

namespace ergodome {

//! Returns the position of the first control character in UTF-8 text (C0 except line breaks, DEL,
//! C1), or npos. In a title or file name these would control the terminal that displays it.
std::size_t find_control(std::string_view text);

//! Returns text from a file for use in one line of a message: control characters and line breaks
//! become escapes such as \x1B.
std::string printable(std::string_view text);

//! Truncates a text to a number of bytes, without splitting a UTF-8 character.
inline std::string_view shortened(std::string_view text, std::size_t max_bytes) {
  if (text.size() <= max_bytes) {
    return text;
  }
  std::size_t end = max_bytes;
  while (end > 0 && (static_cast<unsigned char>(text[end]) & 0xC0U) == 0x80U) {
    --end;
  }
  return text.substr(0, end);
}

//! Returns a number with its noun for messages: "1 gap", "2 gaps", "0 gaps". `several` is the
//! plural, if it is not the noun with an s.
template <class Integer>
std::string counted(Integer count, std::string_view noun, std::string_view several = {}) {
  std::string text = std::to_string(count) + ' ';
  text += count == 1 || several.empty() ? noun : several;
  return count != 1 && several.empty() ? text + 's' : text;
}

}  // namespace ergodome
