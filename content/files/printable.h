#pragma once

#include <string>
#include <string_view>

namespace ergodome {

//! A file's words as a line can say them: characters that would end it, or change a terminal, by their numbers ("\\x00").
std::string printable(std::string_view text);

}  // namespace ergodome
