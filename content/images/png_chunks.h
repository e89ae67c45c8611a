#pragma once

#include <cstddef>
#include <functional>
#include <string>

namespace ergodome {

//! Reads the next `count` bytes of a file; false where there are fewer left.
using NextBytes = std::function<bool(char* to, std::size_t count)>;

//! How far a PNG is looked at.
enum class PngExtent { to_pixels, to_end };

//! What is wrong with the chunks of a PNG from its first byte on: that they break off, or hold other bytes than those whose sum was saved with them. Empty
//! where nothing is, and for files of other formats. The library of PNG says of a torn file that it is one in a line of its own on stderr; so files are looked
//! at before it reads them. No length that the file tells is trusted. Source: ISO/IEC 15948, 5.
std::string problem_of_png(const NextBytes& next, PngExtent extent);

}  // namespace ergodome
