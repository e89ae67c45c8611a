#pragma once

#include <string>
#include <string_view>

namespace ergodome {

//! Returns where the first control character of UTF-8 text begins (C0 without line breaks, DEL, C1), or npos. In a title or
//! a file's name these would change the terminal that shows it.
std::size_t find_control(std::string_view text);

//! Returns text from a file, fit for one line of a message: control characters and line breaks by their numbers ("\\x00").
std::string printable(std::string_view text);

}  // namespace ergodome
