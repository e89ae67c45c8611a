#include "render/output/color_bar.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "content/images/image_library.h"
#include "kernels/image/color_map.h"

namespace ergodome {

namespace {

void set_pixel(Picture& picture, int x, int y, const Vector3<float>& linear) {
  if (x >= 0 && y >= 0 && x < picture.width && y < picture.height) {
    float* to = picture.rgba.data() + 4 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(picture.width) + x);
    to[0] = linear.x;
    to[1] = linear.y;
    to[2] = linear.z;
    to[3] = 1.0F;
  }
}

void fill(Picture& picture, ViewMode mode, const ColorBarLayout& bar) {
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

//! Minimum letter height; smaller letters are unreadable.
constexpr int min_letter_px = 9;
constexpr int largest_letter_px = 64;

int color_bar_letter_px(int height_px) { return std::clamp(height_px / 64, min_letter_px, largest_letter_px); }

//! The title of a color bar: what the view shows and its unit, with a shorter form if there is less
//! room.
struct BarTitle {
  const char* full;
  const char* brief;
};

BarTitle title_of(ViewMode mode) {
  switch (mode) {
    case ViewMode::sky:
      return {"sky", "sky"};
    case ViewMode::steps:
      return {"integration steps", "steps"};
    case ViewMode::error_estimate:
      return {"error estimate [rad]", "error [rad]"};
    case ViewMode::image_order:
      return {"angle swept about the hole [half turns]", "half turns"};
    case ViewMode::frequency_ratio:
      return {"frequency ratio g", "ratio g"};
    case ViewMode::magnification:
      return {"magnification", "magnified"};
  }
  return {"", ""};
}

//! Places texts in a row under a bar, within [from, to] and at least a gap apart.
class BarRow {
 public:
  BarRow(int from, int to, int letter_px) : from_(from), to_(to), letter_px_(letter_px) {}

  //! Adds a text centered at `middle`, but moved so that it is within the range. Returns false if
  //! it overlaps an earlier text or is too wide for the range; in these cases, too, the text is
  //! added.
  bool add(const std::string& text, int middle, int top_y) {
    const int width = image_library().text_box(text, letter_px_).width;
    const int left = std::clamp(middle - width / 2, from_, std::max(from_, to_ - width));
    const bool fits = left >= end_ && left + width <= to_;
    end_ = left + width + letter_px_ / 2;
    texts_.push_back({text, left + width / 2, top_y});
    return fits;
  }
  [[nodiscard]] const std::vector<BarText>& texts() const { return texts_; }

 private:
  int from_;
  int to_;
  int letter_px_;
  int end_ = 0;
  std::vector<BarText> texts_;
};

//! Returns the number of digits that distinguish the numbers at a bar: three, or more for narrow
//! ranges.
int digits_of(const HeatRange& range) {
  const double share = (range.high - range.low) / std::max(std::abs(range.low), std::abs(range.high));
  return 3 + std::clamp(static_cast<int>(-std::log10(std::max(share, 1e-9))), 0, 9);
}

//! Returns the numbers at the ends of a bar, and at three, one or no positions between them,
//! depending on the room; none if there is no room for those at the ends.
std::vector<BarText> bar_numbers(const ColorBarLayout& bar, const HeatRange& range, int from, int to) {
  const int digits = digits_of(range);
  for (const int intervals : {4, 2, 1}) {
    BarRow row(from, to, bar.letter_px);
    bool fits = true;
    for (int i = 0; i <= intervals; ++i) {
      const double part = static_cast<double>(i) / intervals;
      const double value = range.logarithmic ? range.low * std::pow(range.high / range.low, part)
                                             : range.low + part * (range.high - range.low);
      fits = row.add(fmt::format("{:.{}g}", value, digits), bar.left + i * bar.width / intervals,
                     bar.top + bar.height + bar.letter_px / 3) &&
             fits;
    }
    if (fits) {
      return row.texts();
    }
  }
  return {};
}

}  // namespace

bool has_color_bar(int width_px, int height_px) { return width_px >= 160 && height_px >= 100; }

double color_bar_part(int width_px, int height_px) {
  // Numbers, bar and title together are five and a half letters high; half a letter is margin.
  return has_color_bar(width_px, height_px) ? 6.0 * color_bar_letter_px(height_px) / height_px : 0.0;
}

ColorBarLayout color_bar_layout(int width_px, int height_px, const HeatRange& range, ViewMode mode) {
  const int letter_px = color_bar_letter_px(height_px);
  ColorBarLayout bar{width_px / 24, height_px - 4 * letter_px, width_px / 3, letter_px, letter_px, {}};
  if (!has_color_bar(width_px, height_px)) {
    return {};
  }
  const int from = letter_px / 3;
  const int to = width_px / 2 - letter_px / 3;
  bar.texts = bar_numbers(bar, range, from, to);
  const BarTitle title = title_of(mode);
  for (const char* const words : {title.full, title.brief}) {
    BarRow row(from, to, letter_px);
    if (row.add(words, bar.left + bar.width / 2, bar.top - letter_px - letter_px / 2)) {
      bar.texts.push_back(row.texts().front());
      break;
    }
  }
  return bar;
}

void draw_color_bar(Picture& picture, ViewMode mode) {
  if (!picture.heat_range) {
    return;
  }
  const ColorBarLayout bar = color_bar_layout(picture.width, picture.height, *picture.heat_range, mode);
  if (bar.width == 0) {
    return;
  }
  fill(picture, mode, bar);
  const ImageCanvas image = {picture.rgba.data(), picture.width, picture.height, 4};
  const float white[4] = {0.8F, 0.8F, 0.8F, 1.0F};
  for (const BarText& text : bar.texts) {
    image_library().draw_text(image, text.middle_x, text.top_y, text.text,
                              {bar.letter_px, white, TextAnchor::top_centre, 1});
  }
}

}  // namespace ergodome
