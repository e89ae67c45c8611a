#pragma once

#include <array>
#include <optional>
#include <string>

#include "content/images/formats/png_chunks.h"

namespace ergodome {

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

//! Reads the color chunks of a PNG, up to its pixels. Ignores damaged chunks and files of other
//! formats. Source: Portable Network Graphics (third edition), 11.3.2.
PngColors read_png_colors(const NextBytes& next);

//! Returns the uncompressed ICC profile of a PNG, at most 16 MiB and up to its first damaged byte;
//! empty if it has none.
std::string png_icc_profile(const NextBytes& next);

}  // namespace ergodome
