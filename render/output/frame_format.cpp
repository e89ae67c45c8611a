#include "render/output/frame_format.h"

#include <algorithm>

#include "kernels/core/error.h"

namespace ergodome {

namespace {

template <class Word>
Word word_of(const std::vector<std::string>& names, const std::string& name) {
  return static_cast<Word>(std::find(names.begin(), names.end(), name) - names.begin());
}

}  // namespace

const std::vector<std::string>& image_format_names() {
  static const std::vector<std::string> names = {"png", "png16", "tiff", "exr"};
  return names;
}

const std::vector<std::string>& exr_compression_names() {
  static const std::vector<std::string> names = {"zip", "none", "dwaa"};
  return names;
}

FrameFormat frame_format(const std::string& image, const std::string& compression, bool alpha) {
  FrameFormat format;
  format.image = word_of<ImageFormat>(image_format_names(), image);
  format.alpha = alpha;
  if (!compression.empty()) {
    if (format.image != ImageFormat::exr) {
      throw Error("--compression " + compression, "applies only to EXR",
                  "add --format exr, or leave it out; the other formats are lossless");
    }
    format.compression = word_of<ExrCompression>(exr_compression_names(), compression);
  }
  return format;
}

std::string file_ending(ImageFormat format) {
  return format == ImageFormat::exr ? "exr" : format == ImageFormat::tiff ? "tif" : "png";
}

}  // namespace ergodome
