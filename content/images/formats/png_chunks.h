#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>

namespace ergodome {

//! Reads the next `count` bytes of a file; returns false if fewer are left.
using NextBytes = std::function<bool(char* to, std::size_t count)>;

inline constexpr std::string_view png_signature("\x89PNG\r\n\x1A\n", 8);

//! Returns the first four bytes as a big-endian number.
std::uint32_t big_endian_word(std::string_view bytes);

//! How far a PNG is checked: up to its first pixel data, or completely.
enum class PngExtent { to_pixels, to_end };

//! Returns what is wrong with the chunks of a PNG, whose bytes `next` yields from the first on: it
//! is truncated, or a checksum does not match. Returns an empty text for a correct file and for
//! other formats. Lengths in the file are not trusted. Check files before libpng reads them: it
//! reports a damaged file with a line on stderr. Source: ISO/IEC 15948, 5.
std::string problem_of_png(const NextBytes& next, PngExtent extent);

//! Code points of a color space (ITU-T H.273).
struct CodePoints {
  int primaries = 0;
  int transfer = 0;
  int matrix = 0;
  bool full_range = true;
};

//! Color metadata in a PNG's chunks, except for the ICC profile.
struct PngColors {
  std::optional<CodePoints> code_points;           //!< cICP
  bool is_srgb = false;                            //!< sRGB
  double gamma = 0.0;                              //!< gAMA: the encoding exponent; 0 if absent
  std::optional<std::array<double, 8>> primaries;  //!< cHRM: xy of red, green, blue and white
};

//! Reads the color chunks of a PNG, up to its pixels. Ignores chunks of the wrong length and files
//! of other formats; does not verify checksums. Source: Portable Network Graphics (third edition),
//! 11.3.2.
PngColors read_png_colors(const NextBytes& next);

//! Returns the uncompressed ICC profile of a PNG, at most 16 MiB and up to its first damaged byte.
//! Returns an empty string if it has none.
std::string png_icc_profile(const NextBytes& next);

}  // namespace ergodome
