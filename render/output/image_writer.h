#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "render/output/frame_files.h"
#include "render/picture/picture.h"

// Writes image files.

namespace ergodome {

//! Metadata that a frame's file holds, as names and values.
using FrameMetadata = std::vector<std::pair<std::string, std::string>>;

//! Writes a picture. PNG and TIFF hold tone-mapped sRGB with 8 or 16 bits, lossless; EXR holds half
//! floats, linear light and Rec. 709 chromaticities. With alpha, EXR holds light times alpha; PNG
//! and TIFF have straight alpha. Writes atomically: the file is complete or absent. Throws Error
//! with the reason (a full disk, a folder without permission).
void write_picture(const std::filesystem::path& path, const FrameFormat& format, const Picture& picture,
                   const FrameMetadata& metadata);

//! Writes both eyes' pictures as the two parts of one EXR, with `name` and `view` attributes `left`
//! and `right` as OpenEXR's multi-view convention requires; otherwise like write_picture.
void write_views(const std::filesystem::path& path, const FrameFormat& format, const Picture& left,
                 const Picture& right, const FrameMetadata& metadata);

//! Values of named channels at every pixel, row by row from the top; the values of a pixel are
//! adjacent.
struct NumberImage {
  int width = 0;
  int height = 0;
  std::vector<std::string> channels;
  std::vector<float> values;
};

//! Writes values, including NaN, as an EXR of 32-bit floats; otherwise like write_picture.
void write_numbers(const std::filesystem::path& path, ExrCompression compression, const NumberImage& image,
                   const FrameMetadata& metadata);

//! Writes display-referred RGB bytes, top row first, as a PNG; the file is complete or absent.
void write_png(const std::filesystem::path& path, const std::vector<std::uint8_t>& rgb, int width, int height,
               const FrameMetadata& metadata = {});

//! Returns whether a file is an image of this size and number of parts, with all bytes as this
//! program wrote them.
bool is_complete_image(const std::filesystem::path& path, int width, int height, int parts = 1);

//! Returns a metadata value of a file that this program wrote; empty if it has no such name or is
//! not an image.
std::string metadata_of_image(const std::filesystem::path& path, const std::string& name);

}  // namespace ergodome
