#include "render/patterns/test_pattern.h"

#include <fmt/format.h>

#include <algorithm>

#include "content/images/image_library.h"
#include "kernels/core/error.h"
#include "render/patterns/patterns.h"

namespace ergodome {

const std::vector<std::string>& test_pattern_names() {
  static const std::vector<std::string> names = {"orientation", "polar_grid",  "checker",    "grey_ramp", "colour_bars",
                                                 "resolution",  "blend_check", "left_right", "white",     "black"};
  return names;
}

TestPattern test_pattern(const std::string& name) {
  const auto& names = test_pattern_names();
  const auto found = std::find(names.begin(), names.end(), name);
  if (found == names.end()) {
    throw Error(name, "is not a test pattern", fmt::format("choose one of {}", fmt::join(names, ", ")));
  }
  return static_cast<TestPattern>(found - names.begin());
}

Picture draw_test_pattern(TestPattern pattern, const PatternView& projection, FramePart eye) {
  switch (pattern) {
    case TestPattern::polar_grid:
      return polar_grid_pattern(projection);
    case TestPattern::checker:
      return checker_pattern(projection);
    case TestPattern::grey_ramp:
      return grey_ramp_pattern(projection);
    case TestPattern::colour_bars:
      return colour_bar_pattern(projection);
    case TestPattern::resolution:
      return resolution_pattern(projection);
    case TestPattern::blend_check:
      return blend_check_pattern(projection);
    case TestPattern::left_right:
      return left_right_pattern(projection, eye != FramePart::right, eye != FramePart::left);
    case TestPattern::white:
      return even_pattern(projection, 1.0F);
    case TestPattern::black:
      return even_pattern(projection, 0.0F);
    case TestPattern::orientation:
      break;
  }
  return orientation_pattern(projection);
}

namespace {

constexpr float white_line[4] = {1.0F, 1.0F, 1.0F, 1.0F};
constexpr float amber_line[4] = {1.0F, 0.6F, 0.05F, 1.0F};
constexpr float dim_line[4] = {0.3F, 0.3F, 0.3F, 1.0F};

void write(const ImageCanvas& canvas, int x, int y, const std::string& text, int font_px, const float (&colour)[4]) {
  image_library().draw_text(canvas, x, y, text, {std::max(font_px, 1), colour, TextAnchor::centre});
}

//! Draws a circle around the picture's middle: all pixels whose center is less than 0.75 pixels
//! from it.
void draw_circle(Picture& picture, double radius_px) {
  for (int y = 0; y < picture.height; ++y) {
    for (int x = 0; x < picture.width; ++x) {
      const double from_middle = std::hypot(x + 0.5 - 0.5 * picture.width, y + 0.5 - 0.5 * picture.height);
      if (std::abs(from_middle - radius_px) < 0.75) {
        std::copy_n(dim_line, 4, picture.rgba.begin() + 4 * (static_cast<std::ptrdiff_t>(y) * picture.width + x));
      }
    }
  }
}

}  // namespace

Picture draw_projector_number(int number, const std::string& name, int width_px, int height_px) {
  constexpr int largest_px = 16'384;
  if (width_px < 1 || height_px < 1 || width_px > largest_px || height_px > largest_px) {
    throw Error(name, fmt::format("has a raster of {} x {} pixels", width_px, height_px),
                fmt::format("choose 1 to {} pixels a side", largest_px));
  }
  Picture picture;
  picture.width = width_px;
  picture.height = height_px;
  picture.tone = {ToneCurve::gamma, 1.0F, 1.0F, 1.0F};
  picture.rgba.resize(4 * static_cast<std::size_t>(width_px) * static_cast<std::size_t>(height_px));
  for (std::size_t i = 0; i < picture.rgba.size(); ++i) {
    picture.rgba[i] = i % 4 == 3 ? 1.0F : 0.01F;
  }
  const int small = std::min(width_px, height_px);
  draw_circle(picture, 0.45 * small);
  const ImageCanvas image = {picture.rgba.data(), width_px, height_px, 4};
  image_library().draw_line(image, 0, 0, width_px - 1, height_px - 1, dim_line);
  image_library().draw_line(image, 0, height_px - 1, width_px - 1, 0, dim_line);
  image_library().draw_box(image, 0, 0, width_px - 1, height_px - 1, white_line);
  write(image, width_px / 2, height_px / 2, fmt::format("{}", number), small / 3, white_line);
  write(image, width_px / 2, height_px / 2 + small / 4, name, small / 16, amber_line);
  write(image, width_px / 2, height_px / 2 + small / 3, fmt::format("{} x {}", width_px, height_px), small / 24,
        amber_line);
  return picture;
}

}  // namespace ergodome
