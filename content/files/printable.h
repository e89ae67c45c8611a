#pragma once

#include <string>
#include <string_view>

namespace ergodome {

//! Returns the position of the first control character in UTF-8 text (C0 except line breaks, DEL,
//! C1), or npos. In a title or file name these would control the terminal that displays it.
std::size_t find_control(std::string_view text);

//! Returns text from a file for use in one line of a message: control characters and line breaks
//! become escapes ("\\x00").
std::string printable(std::string_view text);

}  // namespace ergodome
