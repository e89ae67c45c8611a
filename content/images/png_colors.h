#pragma once

#include <array>
#include <optional>

#include "content/images/png_chunks.h"

namespace ergodome {

//! Code points of a color space (ITU-T H.273).
struct CodePoints {
  int primaries = 0;
  int transfer = 0;
  int matrix = 0;
  bool full_range = true;
};

//! What the chunks before a PNG's pixels say about its colors, its ICC profile apart.
struct PngColors {
  std::optional<CodePoints> code_points;           //!< cICP
  bool is_srgb = false;                            //!< sRGB
  double gamma = 0.0;                              //!< gAMA, the exponent of encoding; 0 if absent
  std::optional<std::array<double, 8>> primaries;  //!< cHRM: xy of red, green, blue and white
};

//! Reads the chunks of a PNG from its first byte to its first pixels. Other files and damaged chunks yield nothing.
//! Source: Portable Network Graphics (third edition), 11.3.2.
PngColors read_png_colors(const NextBytes& next);

}  // namespace ergodome
