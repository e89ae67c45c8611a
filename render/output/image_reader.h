#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

// Reads image files.

namespace ergodome {

//! Display-referred pixels: red, green, blue, and coverage if requested, 16 bits each, top row
//! first.
struct DisplayPixels {
  int width = 0;
  int height = 0;
  std::vector<std::uint16_t> values;
};

//! Returns the size of an image file, without values. Throws Error if it is not an image, has fewer
//! than three channels, or is larger than 65,535 px a side.
DisplayPixels image_size(const std::filesystem::path& path);

//! Reads the first three channels of a PNG or TIFF, composited on black. Throws Error if that
//! fails.
DisplayPixels read_display_pixels(const std::filesystem::path& path);

//! Reads all four channels of an image, colors not multiplied by alpha. Throws Error if it has not
//! exactly four.
DisplayPixels read_covering_pixels(const std::filesystem::path& path);

}  // namespace ergodome
