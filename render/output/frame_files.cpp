#include "render/output/frame_files.h"

#include <fmt/format.h>

#include <algorithm>

#include "kernels/core/error.h"
#include "render/picture/cube_pictures.h"

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

std::filesystem::path eye_folder(FramePart part) {
  return part == FramePart::whole ? "" : part == FramePart::left ? "L" : "R";
}

std::filesystem::path frame_path(const std::string& name, int index, int frames_in_show, FramePart part,
                                 const std::string& ending, std::optional<CubeFace> face) {
  constexpr int frames_a_folder = 10'000;
  std::filesystem::path path = eye_folder(part);
  if (frames_in_show > frames_a_folder) {
    const int first = index / frames_a_folder * frames_a_folder + 1;
    const int last = first + frames_a_folder - 1;
    path /= fmt::format("{}_{:06}_{:03},{:03}", name, first, last / 1000, last % 1000);
  }
  const std::string face_name = face ? cube_face_name(*face) : std::string();
  return path / fmt::format("{}_{:06}{}{}.{}", name, index + 1, face ? "_" : "", face_name, ending);
}

}  // namespace ergodome
