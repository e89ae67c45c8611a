#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "content/sky/repaired_texels.h"

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

//! A file, and the layer of it that a name such as "sky.exr#ViewLayer.Emit" selects.
struct LayeredFile {
  std::filesystem::path path;
  std::string layer;  //!< empty if the name selects none
};

//! Splits a name at its last "#", unless a file has that whole name.
LayeredFile layered_file(const std::filesystem::path& name);

//! Reads an equirectangular image (2:1; EXR, HDR, PNG, TIFF, JPEG, ...) through OpenImageIO. The name may select a layer of OpenEXR.
//!
//! Colors become linear light of Rec. 709 by what the file says about them; if it says nothing, whole numbers are sRGB and floating
//! point is linear. A crop of a panorama is put in its position (GPano), with black around it. What alpha leaves
//! of a colour is its light over black: half of it where alpha is one half. Grey becomes colour. Wider images than `largest_width` are averaged down to it while they are read, so a 32k map needs no
//! more memory than an 8k one. Throws Error for what is missing, torn, of another shape, narrower than 8 or wider than 65536 pixels,
//! or without a single texel that is a number.
EnvironmentImage read_environment_image(const std::filesystem::path& name, int largest_width = 8192);

//! The same from a file's bytes in memory; `name` (with its ending) tells the format.
EnvironmentImage read_environment_image(std::span<const std::byte> bytes, const std::string& name,
                                        int largest_width = 8192);

}  // namespace ergodome
