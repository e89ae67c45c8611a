#include "render/output/color_bar.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "content/images/image_library.h"
#include "kernels/image/color_map.h"

namespace ergodome {

namespace {

struct Bar {
  int left, top, width, height;
};

void set_pixel(Picture& picture, int x, int y, const Vector3<float>& linear) {
  if (x >= 0 && y >= 0 && x < picture.width && y < picture.height) {
    float* to = picture.rgba.data() + 4 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(picture.width) + x);
    to[0] = linear.x;
    to[1] = linear.y;
    to[2] = linear.z;
    to[3] = 1.0F;
  }
}

void fill(Picture& picture, ViewMode mode, const Bar& bar) {
  for (int x = -1; x <= bar.width; ++x) {
    const float value = (static_cast<float>(x) + 0.5F) / static_cast<float>(bar.width);
    const Vector3<float> shown = mode == ViewMode::frequency_ratio ? shift_color(value) : heat_color(value);
    const Vector3<float> linear = {srgb_decoded(shown.x), srgb_decoded(shown.y), srgb_decoded(shown.z)};
    for (int y = -1; y <= bar.height; ++y) {
      const bool frame = x < 0 || y < 0 || x == bar.width || y == bar.height;
      set_pixel(picture, bar.left + x, bar.top + y, frame ? Vector3<float>{0.6F, 0.6F, 0.6F} : linear);
    }
  }
}

void write(const ImageCanvas& canvas, int x, int y, const std::string& text, int font_px) {
  const float white[4] = {0.8F, 0.8F, 0.8F, 1.0F};
  image_library().draw_text(canvas, x, y, text, {font_px, white, TextPlace::top_centre, 1});
}

void label(Picture& picture, ViewMode mode, const Bar& bar, int font_px) {
  const ImageCanvas image = {picture.rgba.data(), picture.width, picture.height, 4};
  constexpr int ticks = 4;
  const HeatRange& range = *picture.heat_range;
  for (int i = 0; i <= ticks; ++i) {
    const double part = static_cast<double>(i) / ticks;
    const double value = range.logarithmic ? range.low * std::pow(range.high / range.low, part)
                                           : range.low + part * (range.high - range.low);
    write(image, bar.left + static_cast<int>(part * bar.width), bar.top + bar.height + font_px / 3,
          fmt::format("{:.2g}", value), font_px);
  }
  write(image, bar.left + bar.width / 2, bar.top - font_px - font_px / 2, title_of(mode), font_px);
}

}  // namespace

std::string title_of(ViewMode mode) {
  switch (mode) {
    case ViewMode::sky:
      return "sky";
    case ViewMode::steps:
      return "integration steps";
    case ViewMode::error_estimate:
      return "error estimate [rad]";
    case ViewMode::image_order:
      return "angle swept about the hole [half turns]";
    case ViewMode::frequency_ratio:
      return "frequency ratio g";
    case ViewMode::magnification:
      return "magnification";
  }
  return "";
}

void draw_color_bar(Picture& picture, ViewMode mode) {
  const int font_px = std::clamp(picture.height / 64, 9, 64);
  if (!picture.heat_range || picture.width < 160 || picture.height < 100) {
    return;
  }
  const Bar bar{picture.width / 24, picture.height - 4 * font_px, picture.width / 3, font_px};
  fill(picture, mode, bar);
  label(picture, mode, bar, font_px);
}

}  // namespace ergodome
