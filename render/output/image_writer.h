#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "render/frame/eye_renderer.h"
#include "render/output/frame_format.h"

namespace ergodome {

//! Facts about a frame that its file carries, name and value.
using FrameMetadata = std::vector<std::pair<std::string, std::string>>;

//! Writes a picture. What a display shows is tone-mapped sRGB with 8 or 16 bits, lossless; EXR has half floats, linear light and Rec. 709
//! chromaticities. With alpha, EXR and TIFF hold light times alpha, as both formats have it; PNG's own rule is light that is not.
//! The file is there whole or not at all; Error says why not (a full disk, a folder without permission).
void write_picture(const std::filesystem::path& path, const FrameFormat& format, const Picture& picture,
                   const FrameMetadata& metadata);

//! Writes the pictures of both eyes as the two parts of one EXR, named and viewed `left` and `right` as OpenEXR's multi-view convention has
//! it (attributes `name` and `view`); otherwise as write_picture does.
void write_views(const std::filesystem::path& path, const FrameFormat& format, const Picture& left,
                 const Picture& right, const FrameMetadata& metadata);

//! Numbers of named channels at every pixel, row by row from the top; those of one pixel lie side by side.
struct NumberImage {
  int width = 0;
  int height = 0;
  std::vector<std::string> channels;
  std::vector<float> values;
};

//! Writes numbers as an EXR of 32-bit floats, NaN among them; otherwise as write_picture does.
void write_numbers(const std::filesystem::path& path, ExrCompression compression, const NumberImage& image,
                   const FrameMetadata& metadata);

//! Writes display-referred RGB bytes, the top row first, as a PNG; whole or not at all.
void write_png(const std::filesystem::path& path, const std::vector<std::uint8_t>& rgb, int width, int height,
               const FrameMetadata& metadata = {});

//! Whether a file is an image of this size, of this many parts, with all bytes as they were written here.
bool is_complete_image(const std::filesystem::path& path, int width, int height, int parts = 1);

//! What a file that was written here carries under a name; empty where it has no such fact, or is no image.
std::string fact_of_image(const std::filesystem::path& path, const std::string& name);

}  // namespace ergodome
