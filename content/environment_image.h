#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "content/repaired_texels.h"

namespace ergodome {

//! A sky as an equirectangular image: linear light, three floats a texel, the top row first.
struct EnvironmentImage {
  std::string name;
  int width = 0;
  int height = 0;           //!< width / 2
  int file_width = 0;       //!< of the file's image, which may be wider; 0: of no file
  std::vector<float> rgb;   //!< 3 * width * height, finite and >= 0
  RepairedTexels repaired;  //!< of the file
};

//! Reads an equirectangular image (2:1; EXR, HDR, PNG, TIFF, JPEG, ...) through OpenImageIO.
//!
//! Whole numbers are decoded from sRGB, unless the file says that they are linear; floating point is linear. What alpha leaves
//! of a colour is its light over black: half of it where alpha is one half. Grey becomes colour. Wider images than `largest_width` are averaged down to it while they are read, so a 32k map needs no
//! more memory than an 8k one. Throws Error for what is missing, torn, of another shape, narrower than 8 or wider than 65536 pixels,
//! or without a single texel that is a number.
EnvironmentImage read_environment_image(const std::filesystem::path& path, int largest_width = 8192);

//! The same from a file's bytes in memory; `name` (with its ending) tells the format.
EnvironmentImage read_environment_image(std::span<const std::byte> bytes, const std::string& name,
                                        int largest_width = 8192);

}  // namespace ergodome
