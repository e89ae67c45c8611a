#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

namespace ergodome {

//! A mask: a number from 0 to 1 for each channel of each sample, as stored in the file (without
//! gamma decoding). Rows from top to bottom.
struct BlendMap {
  int width = 0;
  int height = 0;
  int channels = 1;           //!< 1 or 3
  int bit_depth = 8;          //!< 8 or 16, as in the file; writers use it
  std::vector<float> values;  //!< channels * width * height
};

//! Reads a mask from the bytes of an image (PNG, TIFF and other formats that OpenImageIO recognizes
//! by the extension of `name`). Throws Error if it is not an image, damaged, smaller than 2 x 2,
//! beyond the limits of warp_mesh.h, or neither gray nor RGB.
BlendMap parse_blend_map(std::span<const std::byte> bytes, const std::string& name);

//! Reads a mask from a file.
BlendMap read_blend_map(const std::filesystem::path& path);

//! Returns true if a mask of any size has the aspect ratio of a raster: its height deviates by at
//! most one sample or 2 %.
bool has_shape_of(const BlendMap& map, int width_px, int height_px);

//! Returns a mask with the aspect ratio of a raster: unchanged if it has that ratio, otherwise
//! resampled linearly to a sample per pixel.
BlendMap in_shape_of(const BlendMap& map, int width_px, int height_px);

//! Returns a mask as the bytes of a PNG with its bit depth.
std::string to_png(const BlendMap& map, const std::string& name);

}  // namespace ergodome
