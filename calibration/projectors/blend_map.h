#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

namespace ergodome {

//! A mask: a number from 0 to 1 for each channel of each sample, as the file holds it (no gamma is taken out). Rows from top to
//! bottom.
struct BlendMap {
  int width = 0;
  int height = 0;
  int channels = 1;           //!< 1 or 3
  int bit_depth = 8;          //!< 8 or 16: what the file had, and what a writer uses
  std::vector<float> values;  //!< channels * width * height
};

//! Reads a mask from an image's bytes (PNG, TIFF and what else OpenImageIO knows by the ending of `name`). Throws Error for what is no
//! image, torn, smaller than 2 x 2, beyond the bounds of warp_mesh.h, or neither grey nor RGB.
BlendMap parse_blend_map(std::span<const std::byte> bytes, const std::string& name);

//! The same from a file.
BlendMap read_blend_map(const std::filesystem::path& path);

//! Whether a mask has the shape of a raster, in any size; those of small ones are rounded.
bool has_shape_of(const BlendMap& map, int width_px, int height_px);

//! A mask in the shape of a raster: as it is where it has that, else with a sample for each pixel, linear between the mask's own.
BlendMap in_shape_of(const BlendMap& map, int width_px, int height_px);

//! A mask as the bytes of a PNG of its bit depth.
std::string to_png(const BlendMap& map, const std::string& name);

}  // namespace ergodome
