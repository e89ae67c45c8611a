#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <string_view>

namespace ergodome {

//! Reads the next `count` bytes of a file; false where there are fewer left.
using NextBytes = std::function<bool(char* to, std::size_t count)>;

inline constexpr std::string_view png_signature("\x89PNG\r\n\x1A\n", 8);

//! Returns the first four bytes as a number, the most significant one first.
std::uint32_t big_endian_word(std::string_view bytes);

//! How far a PNG is checked.
enum class PngExtent { to_pixels, to_end };

//! What is wrong with the chunks of a PNG from its first byte on: that they break off, or hold other bytes than those whose sum was saved with them. Empty
//! where nothing is, and for files of other formats. The library of PNG says of a torn file that it is one in a line of its own on stderr; so files are looked
//! at before it reads them. No length that the file tells is trusted. Source: ISO/IEC 15948, 5.
std::string problem_of_png(const NextBytes& next, PngExtent extent);

}  // namespace ergodome
