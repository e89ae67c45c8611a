#pragma once

#include <optional>
#include <string>
#include <vector>

#include "content/timeline/frame_rate.h"

namespace ergodome {

//! PNG with 8 or 16 bits a channel and TIFF with 16 hold what a display shows (tone-mapped, sRGB); EXR holds linear light.
enum class ImageFormat { png, png16, tiff, exr };

//! How an EXR is packed: `zip` and `none` keep every half float; `dwaa` is lossy, several times smaller.
enum class ExrCompression { zip, none, dwaa };

//! How pictures become files.
struct FrameFormat {
  ImageFormat image = ImageFormat::png;
  ExrCompression compression = ExrCompression::zip;  //!< of EXR alone
  bool alpha = false;                                //!< a fourth channel: how much of a pixel the image covers
  std::optional<FrameRate> rate{};                   //!< that an EXR tells of its sequence
};

//! The words for ImageFormat and for ExrCompression, in their order.
const std::vector<std::string>& image_format_names();
const std::vector<std::string>& exr_compression_names();

//! The format of words that are among those names; an empty compression is zip. Throws Error where a compression is asked of anything but
//! EXR.
FrameFormat frame_format(const std::string& image, const std::string& compression, bool alpha);

//! What names of such files end with, without the dot.
std::string file_ending(ImageFormat format);

}  // namespace ergodome
