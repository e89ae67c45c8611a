#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

namespace ergodome {

//! Pixels as a display shows them: red, green, blue, and coverage where that was asked for, 16 bits each, the top row first.
struct DisplayPixels {
  int width = 0;
  int height = 0;
  std::vector<std::uint16_t> values;
};

//! Size of an image file, without its pixels. Throws Error where it is none, or larger than 65,535 px a side.
DisplayPixels image_size(const std::filesystem::path& path);

//! Reads the first three channels of a PNG or TIFF; what is transparent comes on black. Throws Error where that fails.
DisplayPixels read_display_pixels(const std::filesystem::path& path);

//! Reads all four channels of one with coverage, the light beside it (straight). Throws Error where it has none.
DisplayPixels read_covering_pixels(const std::filesystem::path& path);

}  // namespace ergodome
