#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "content/sky/repaired_texels.h"

namespace ergodome {

//! A sky as an equirectangular image: linear light, three floats per texel, top row first.
struct EnvironmentImage {
  std::string name;
  int width = 0;
  int height = 0;           //!< width / 2
  int file_width = 0;       //!< width of the image in the file, which may be larger; 0 if there is no file
  std::vector<float> rgb;   //!< 3 * width * height, finite and >= 0
  RepairedTexels repaired;  //!< statistics of invalid texels in the file
};

//! A file, and the layer that a name such as "sky.exr#ViewLayer.Emit" selects.
struct LayeredFile {
  std::filesystem::path path;
  std::string layer;  //!< empty if the name does not select one
};

//! Splits a name at its last "#", unless a file with the full name exists.
LayeredFile layered_file(const std::filesystem::path& name);

//! Reads an equirectangular image (2:1; EXR, HDR, PNG, TIFF, JPEG, ...) through OpenImageIO. The
//! name may select an OpenEXR layer.
//!
//! Colors become linear Rec. 709 light according to the file's metadata; without metadata, integers
//! are sRGB and floating point is linear. Gray becomes RGB, and transparent colors are blended over
//! black. A crop of a panorama (GPano) is put at its position in a black one. Images wider than
//! `largest_width` are averaged down to it while they are read, so a 32k map needs no more memory
//! than an 8k one.
//!
//! Throws Error if the file is missing, damaged, of another shape, narrower than 8 or wider than
//! 65536 pixels, or has only NaN texels.
EnvironmentImage read_environment_image(const std::filesystem::path& name, int largest_width = 8192);

//! Reads such an image from the bytes of a file; the ending of `name` gives its format.
EnvironmentImage read_environment_image(std::span<const std::byte> bytes, const std::string& name,
                                        int largest_width = 8192);

}  // namespace ergodome
