#include "render/output/color_bar.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

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

//! The letters' height, made smaller where a text is wider than its room [px].
int fitting_px(const std::string& text, int font_px, int room_px) {
  constexpr int least_px = 6;
  while (font_px > least_px && image_library().text_box(text, font_px).width > room_px) {
    --font_px;
  }
  return font_px;
}

void label(Picture& picture, ViewMode mode, const Bar& bar, int font_px) {
  const ImageCanvas image = {picture.rgba.data(), picture.width, picture.height, 4};
  constexpr int ticks = 4;
  const HeatRange& range = *picture.heat_range;
  std::vector<std::string> numbers;
  int number_px = font_px;
  for (int i = 0; i <= ticks; ++i) {
    const double part = static_cast<double>(i) / ticks;
    const double value = range.logarithmic ? range.low * std::pow(range.high / range.low, part)
                                           : range.low + part * (range.high - range.low);
    numbers.push_back(fmt::format("{:.3g}", value));
    number_px = std::min(number_px, fitting_px(numbers.back(), font_px, bar.width / ticks * 9 / 10));
  }
  for (int i = 0; i <= ticks; ++i) {
    write(image, bar.left + i * bar.width / ticks, bar.top + bar.height + font_px / 3,
          numbers[static_cast<std::size_t>(i)], number_px);
  }
  const std::string title = title_of(mode);
  const int middle = bar.left + bar.width / 2;
  const int title_px = fitting_px(title, font_px, 2 * std::min(middle, picture.width - middle) * 19 / 20);
  write(image, middle, bar.top - font_px - font_px / 2, title, title_px);
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
