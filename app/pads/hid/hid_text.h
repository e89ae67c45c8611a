#pragma once

#include <string>
#include <string_view>

namespace ergodome {

//! Converts a device's text to UTF-8 with at most 120 characters. Removes control characters,
//! surrounding blanks and invalid characters; returns "" for a null pointer.
std::string text_of(const wchar_t* text);

//! Removes ASCII control characters and surrounding blanks from UTF-8 text of a fixture, and uses
//! at most its first 480 bytes.
std::string without_controls(std::string_view text);

}  // namespace ergodome
