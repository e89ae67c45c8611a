#pragma once

#include <string>
#include <string_view>

namespace ergodome {

//! A device's text as UTF-8, at most 120 characters, without control characters, blanks about it, or what is no character; "" for a
//! null pointer.
std::string text_of(const wchar_t* text);

//! The same for text that is UTF-8 already, of a fixture.
std::string without_controls(std::string_view text);

}  // namespace ergodome
