#include "render/output/image_reader.h"

#include <OpenImageIO/imageio.h>
#include <fmt/format.h>

#include "kernels/core/error.h"

namespace ergodome {

namespace {

Error unreadable(const std::filesystem::path& path, const std::string& reason) {
  return {path.string(), "cannot be read: " + reason, "render it again"};
}

std::unique_ptr<OIIO::ImageInput> opened(const std::filesystem::path& path) {
  constexpr int most_px = 65'535;
  auto input = OIIO::ImageInput::open(path.string());
  if (!input) {
    throw unreadable(path, OIIO::geterror());
  }
  const OIIO::ImageSpec& spec = input->spec();
  if (spec.width < 1 || spec.height < 1 || spec.width > most_px || spec.height > most_px || spec.nchannels < 3) {
    throw unreadable(path, fmt::format("{} x {} pixels of {} channels", spec.width, spec.height, spec.nchannels));
  }
  return input;
}

}  // namespace

DisplayPixels image_size(const std::filesystem::path& path) {
  const auto input = opened(path);
  return {input->spec().width, input->spec().height, {}};
}

DisplayPixels read_display_pixels(const std::filesystem::path& path) {
  const auto input = opened(path);
  DisplayPixels pixels = {input->spec().width, input->spec().height, {}};
  pixels.rgb.resize(3 * static_cast<std::size_t>(pixels.width) * static_cast<std::size_t>(pixels.height));
  if (!input->read_image(0, 0, 0, 3, OIIO::TypeDesc::UINT16, pixels.rgb.data())) {
    throw unreadable(path, input->geterror());
  }
  return pixels;
}

}  // namespace ergodome
