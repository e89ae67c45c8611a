#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "content/timeline/frame_rate.h"
#include "render/picture/picture.h"

// Formats and paths of frame files.

namespace ergodome {

//! PNG with 8 or 16 bits per channel and TIFF with 16 hold display values (tone-mapped, sRGB); EXR
//! holds linear light.
enum class ImageFormat { png, png16, tiff, exr };

//! Compression of EXR files: `zip` and `none` are lossless; `dwaa` is lossy and several times
//! smaller.
enum class ExrCompression { zip, none, dwaa };

//! Format of picture files.
struct FrameFormat {
  ImageFormat image = ImageFormat::png;
  ExrCompression compression = ExrCompression::zip;  //!< compression of EXR files; unused for other formats
  //! Adds a fourth channel: the coverage of each pixel.
  bool alpha = false;
  std::optional<FrameRate> rate{};  //!< frame rate to store in EXR files
};

//! image_format_names() returns the names of ImageFormat, exr_compression_names() those of
//! ExrCompression, in the order of the enumerators.
const std::vector<std::string>& image_format_names();
const std::vector<std::string>& exr_compression_names();

//! Returns the format with these names, which must be in image_format_names() and
//! exr_compression_names(); an empty compression means zip. Throws Error if a compression is given
//! for a format other than EXR.
FrameFormat frame_format(const std::string& image, const std::string& compression, bool alpha);

//! Returns the file name extension of a format, without the dot.
std::string file_ending(ImageFormat format);

//! Returns the folder for the files of a single eye: L or R; empty if a file does not belong to a
//! single eye.
std::filesystem::path eye_folder(FramePart part);

//! Returns the path of a numbered frame inside the output folder: NAME_000001.png, counted from 1.
//! Separate eyes are in L/ and R/. Sequences of more than 10,000 frames are in folders
//! NAME_000001_010,000 (domemaster convention). A cube's faces are NAME_000001_px.png (see
//! cube_face_name). `index` counts from 0.
std::filesystem::path frame_path(const std::string& name, int index, int frames_in_show, FramePart part,
                                 const std::string& ending, std::optional<CubeFace> face = std::nullopt);

}  // namespace ergodome
