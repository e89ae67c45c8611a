#pragma once

#include <optional>
#include <string>
#include <vector>

#include "content/timeline/frame_rate.h"

// File formats of frames.

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
  ExrCompression compression = ExrCompression::zip;  //!< EXR only
  //! Adds a fourth channel: the coverage of each pixel.
  bool alpha = false;
  std::optional<FrameRate> rate{};  //!< stored in EXR files
};

//! Return the names of ImageFormat and ExrCompression values, in their order.
const std::vector<std::string>& image_format_names();
const std::vector<std::string>& exr_compression_names();

//! Returns the format with these names; an empty compression means zip. Throws Error if a
//! compression is given for a format other than EXR.
FrameFormat frame_format(const std::string& image, const std::string& compression, bool alpha);

//! Returns the file name extension of a format, without the dot.
std::string file_ending(ImageFormat format);

}  // namespace ergodome
