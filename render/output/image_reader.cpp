#include "render/output/image_reader.h"

#include <fmt/format.h>

#include "content/images/image_library.h"
#include "kernels/core/error.h"

namespace ergodome {

namespace {

Error unreadable(const std::filesystem::path& path, const std::string& reason) {
  return {path.string(), "cannot be read: " + reason, "render it again"};
}

std::unique_ptr<ImageInput> opened(const std::filesystem::path& path, const ImageLibrary::Wishes& wishes = {}) {
  constexpr int max_px = 65'535;
  std::string problem;
  auto input = image_library().open(path.string(), wishes, problem);
  if (!input) {
    throw unreadable(path, problem);
  }
  const ImageShape& shape = input->shape();
  if (shape.width < 1 || shape.height < 1 || shape.width > max_px || shape.height > max_px || shape.channels < 3) {
    throw unreadable(path, fmt::format("{} x {} pixels with {} channels are not supported", shape.width, shape.height,
                                       shape.channels));
  }
  return input;
}

DisplayPixels read_channels(const std::filesystem::path& path, ImageInput& input, int channels) {
  DisplayPixels pixels = {input.shape().width, input.shape().height, {}};
  pixels.values.resize(static_cast<std::size_t>(channels) * static_cast<std::size_t>(pixels.width) *
                       static_cast<std::size_t>(pixels.height));
  if (!input.read_all(channels, pixels.values.data())) {
    throw unreadable(path, input.error());
  }
  return pixels;
}

}  // namespace

DisplayPixels image_size(const std::filesystem::path& path) {
  const auto input = opened(path);
  return {input->shape().width, input->shape().height, {}};
}

DisplayPixels read_display_pixels(const std::filesystem::path& path) { return read_channels(path, *opened(path), 3); }

DisplayPixels read_covering_pixels(const std::filesystem::path& path) {
  ImageLibrary::Wishes wishes;
  wishes.separate_alpha = true;
  const auto input = opened(path, wishes);
  if (input->shape().channels != 4) {
    throw unreadable(path, "it has no alpha channel");
  }
  return read_channels(path, *input, 4);
}

}  // namespace ergodome
