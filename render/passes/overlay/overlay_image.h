#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "kernels/overlay/overlay_texture.h"

namespace ergodome {

//! An overlay image with its mip levels; see OverlayTexture.
struct OverlayImage {
  int width = 0;
  int height = 0;
  int level_count = 0;
  std::array<long, overlay_level_limit> level_offset{};  //!< index of each level's first texel
  std::vector<std::uint16_t> texels;                     //!< four values per texel

  //! Returns the image in the form that kernels read; `at`: address of its texels.
  [[nodiscard]] OverlayTexture view(const std::uint16_t* at) const;
};

//! Maximum width and height of an overlay image [px].
inline constexpr int longest_overlay_px = 8192;

//! Returns the size of an image with its mip levels [bytes].
long overlay_image_bytes(int width, int height);

//! Builds an image with its mip levels from linear display light times alpha: four floats per
//! pixel, top row first. Values are clamped to [0, 1].
OverlayImage make_overlay_image(int width, int height, const std::vector<float>& rgba);

//! Size of an image [px].
struct OverlaySize {
  int width;
  int height;
};
//! Reads the width and height of an image file [px] without its pixels. Throws Error like
//! read_overlay_image.
OverlaySize overlay_image_size(const std::filesystem::path& path);

//! Reads an image with OpenImageIO. Integers are decoded from sRGB unless the file declares them
//! linear; floating point is linear. Gray is converted to RGB; images without alpha are opaque.
//! Throws Error if the file is missing or damaged, or if a side exceeds longest_overlay_px.
OverlayImage read_overlay_image(const std::filesystem::path& path);

//! Reads a texture of a mesh. Unlike read_overlay_image(), does not turn the image upright, because
//! texture coordinates refer to the stored pixels, and does not multiply colors by alpha, because
//! meshes are drawn opaque; alpha is stored as a separate value.
OverlayImage read_stored_image(const std::filesystem::path& path);

//! Reads a texture from the bytes of an image file. `name` must have the file's extension; messages
//! use it.
OverlayImage read_stored_image(std::string_view bytes, const std::string& name);

}  // namespace ergodome
