#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <string_view>

namespace ergodome {

//! Reads the next `count` bytes of a file; returns false if fewer are left.
using NextBytes = std::function<bool(char* to, std::size_t count)>;

inline constexpr std::string_view png_signature("\x89PNG\r\n\x1A\n", 8);

//! Returns the first four bytes as a big-endian number.
std::uint32_t big_endian_word(std::string_view bytes);

//! How far a PNG is checked.
enum class PngExtent { to_pixels, to_end };

//! Returns what is wrong with the chunks of a PNG, whose bytes `next` yields from the first on: it
//! is truncated, or a checksum does not match. Returns an empty text for a correct file and for
//! other formats. Lengths in the file are not trusted. Check files before libpng reads them: it
//! reports a damaged file with a line on stderr. Source: ISO/IEC 15948, 5.
std::string problem_of_png(const NextBytes& next, PngExtent extent);

}  // namespace ergodome
