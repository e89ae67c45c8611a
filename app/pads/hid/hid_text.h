#pragma once

#include <string>
#include <string_view>

namespace ergodome {

//! Converts a device's text to UTF-8 with at most 120 characters. Removes control characters,
//! surrounding blanks and invalid characters; returns "" for a null pointer.
std::string text_of(const wchar_t* text);

//! Cleans text that is already UTF-8, from a fixture, in the same way as text_of().
std::string without_controls(std::string_view text);

}  // namespace ergodome
