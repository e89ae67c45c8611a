#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "kernels/overlay/overlay_texture.h"

namespace ergodome {

//! An image to lay over pictures, with its levels: see OverlayTexture.
struct OverlayImage {
  int width = 0;
  int height = 0;
  int level_count = 0;
  std::array<long, overlay_level_limit> level_offset{};  //!< in texels
  std::vector<std::uint16_t> texels;                     //!< four a texel

  //! As kernels read it, with its texels at some place.
  [[nodiscard]] OverlayTexture view(const std::uint16_t* at) const;
};

//! Sides of an image to lay over pictures are no longer than this [px].
inline constexpr int longest_overlay_px = 8192;

//! Bytes of an image of a size with its levels.
long overlay_image_bytes(int width, int height);

//! Makes the levels of an image: light as a display shows it, linear, times alpha; four floats a pixel, the top row first. What is not between 0
//! and 1 is brought there.
OverlayImage make_overlay_image(int width, int height, const std::vector<float>& rgba);

//! Width and height of an image file [px], without its pixels. Throws Error like read_overlay_image.
struct OverlaySize {
  int width;
  int height;
};
OverlaySize overlay_image_size(const std::filesystem::path& path);

//! Reads an image through OpenImageIO. Whole numbers are decoded from sRGB, unless the file says that they are linear; floating point is linear.
//! Grey becomes colour; without alpha all of it covers. Throws Error for what is missing, torn, or larger than longest_overlay_px a side.
OverlayImage read_overlay_image(const std::filesystem::path& path);

//! Reads a texture of a mesh. Unlike read_overlay_image it neither turns the image upright, because texture coordinates
//! count stored pixels, nor multiplies colors by alpha, because meshes are drawn opaque; alpha stays beside them.
OverlayImage read_stored_image(const std::filesystem::path& path);

//! The same of a file's bytes; `name` ends as such a file's would, and messages call it so.
OverlayImage read_stored_image(std::string_view bytes, const std::string& name);

}  // namespace ergodome
