#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "render/frame/eye_renderer.h"

namespace ergodome {

enum class ImageFormat { png, exr };

//! Facts about a frame that its file carries, name and value.
using FrameMetadata = std::vector<std::pair<std::string, std::string>>;

//! Writes a picture: PNG with 8 bits, tone-mapped, sRGB; or EXR with half floats, linear light, Rec. 709 chromaticities, lossless
//! compression. The file is there whole or not at all; Error says why not (a full disk, a folder without permission).
void write_picture(const std::filesystem::path& path, ImageFormat format, const Picture& picture,
                   const FrameMetadata& metadata);

//! Writes display-referred RGB bytes, the top row first, as a PNG; whole or not at all.
void write_png(const std::filesystem::path& path, const std::vector<std::uint8_t>& rgb, int width, int height);

//! Whether a file is an image of this size that can be read to its last pixel.
bool is_complete_image(const std::filesystem::path& path, int width, int height);

}  // namespace ergodome
