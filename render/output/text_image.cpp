#include "render/output/text_image.h"

#include <pango/pangocairo.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <memory>

#include "content/images/image_library.h"

namespace ergodome {

TextImage text_image(const std::string& text, int font_px) {
  const TextBox box = image_library().text_box(text, font_px);
  if (box.width <= 0 || box.height <= 0) {
    return {};
  }
  TextImage image{box.width, box.height, {}};
  image.coverage.resize(static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height));
  const float white[1] = {1.0F};
  if (!image_library().draw_text({image.coverage.data(), image.width, image.height, 1}, -box.left, -box.top, text,
                                 {font_px, white})) {
    return {};
  }
  return image;
}

namespace {

struct Free {
  void operator()(cairo_t* context) const noexcept { cairo_destroy(context); }
  void operator()(cairo_surface_t* surface) const noexcept { cairo_surface_destroy(surface); }
  void operator()(PangoFontDescription* font) const noexcept { pango_font_description_free(font); }
  void operator()(PangoContext* context) const noexcept { g_object_unref(context); }
  void operator()(PangoLayout* layout) const noexcept { g_object_unref(layout); }
};
template <class T>
using Owned = std::unique_ptr<T, Free>;

constexpr int longest_px = 8192;

//! Lines that are laid out for drawing; `size` is 0 if text_lines_image() draws nothing.
struct LaidLines {
  Owned<PangoContext> context;
  Owned<PangoLayout> layout;
  TextLinesSize size;
  //! Left edge of the lines within the layout: right-to-left lines are at the right end of the
  //! layout.
  int left_px = 0;
  int margin_px = 0;
};

PangoRectangle pixels_of(PangoLayout* layout) {
  PangoRectangle lines;
  pango_layout_get_pixel_extents(layout, nullptr, &lines);
  return lines;
}

LaidLines laid_lines(const std::string& text, int font_px, TextFace face, int widest_px) {
  LaidLines laid;
  laid.context.reset(pango_font_map_create_context(pango_cairo_font_map_get_default()));
  laid.layout.reset(pango_layout_new(laid.context.get()));
  const Owned<PangoFontDescription> font(
      pango_font_description_from_string(face == TextFace::monospaced ? "DejaVu Sans Mono" : "DejaVu Sans"));
  pango_font_description_set_absolute_size(font.get(), static_cast<double>(font_px) * PANGO_SCALE);
  pango_layout_set_font_description(laid.layout.get(), font.get());
  pango_layout_set_spacing(laid.layout.get(), font_px * PANGO_SCALE / 4);
  pango_layout_set_text(laid.layout.get(), text.c_str(), -1);
  laid.margin_px = font_px / 2;
  PangoRectangle lines = pixels_of(laid.layout.get());
  if (widest_px > 0 && lines.width + 2 * laid.margin_px > widest_px) {
    pango_layout_set_wrap(laid.layout.get(), PANGO_WRAP_WORD_CHAR);
    pango_layout_set_width(laid.layout.get(), std::max(widest_px - 2 * laid.margin_px, 1) * PANGO_SCALE);
    lines = pixels_of(laid.layout.get());
  }
  laid.left_px = lines.x;
  if (!text.empty() && lines.width > 0 && lines.width <= longest_px && lines.height <= longest_px) {
    const int width = lines.width + 2 * laid.margin_px;
    // The image is never wider than `widest_px`, even if that is narrower than a letter.
    laid.size = {widest_px > 0 ? std::min(width, widest_px) : width, lines.height + 2 * laid.margin_px};
  }
  return laid;
}

}  // namespace

TextLinesSize text_lines_size(const std::string& text, int font_px, TextFace face, int widest_px) {
  return laid_lines(text, font_px, face, widest_px).size;
}

TextImage text_lines_image(const std::string& text, int font_px, TextFace face, int widest_px) {
  const LaidLines laid = laid_lines(text, font_px, face, widest_px);
  if (laid.size.width == 0) {
    return {};
  }
  TextImage image{laid.size.width, laid.size.height, {}};
  const Owned<cairo_surface_t> surface(cairo_image_surface_create(CAIRO_FORMAT_A8, image.width, image.height));
  const Owned<cairo_t> drawing(cairo_create(surface.get()));
  cairo_move_to(drawing.get(), laid.margin_px - laid.left_px, laid.margin_px);
  pango_cairo_show_layout(drawing.get(), laid.layout.get());
  cairo_surface_flush(surface.get());
  const unsigned char* const rows = cairo_image_surface_get_data(surface.get());
  const int stride = cairo_image_surface_get_stride(surface.get());
  image.coverage.reserve(static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height));
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < image.width; ++x) {
      image.coverage.push_back(static_cast<float>(rows[static_cast<std::ptrdiff_t>(y) * stride + x]) / 255.0F);
    }
  }
  return image;
}

namespace {

//! Reach of the rim as a fraction of the line height, its maximum darkness, and the factor on the
//! blurred coverage that becomes the darkness.
constexpr double rim_reach = 0.22;
constexpr float rim_darkness = 0.97F;
constexpr float rim_gain = 5.0F;

//! Replaces each value by the mean of the 2 reach + 1 values around it in its line; beyond the ends
//! values are 0. Lines start `line` elements apart, and the `count` values of a line are `step`
//! elements apart.
void blur_lines(std::vector<float>& values, int lines, long line, int count, long step, int reach) {
  std::vector<float> before(static_cast<std::size_t>(count));
  for (int i = 0; i < lines; ++i) {
    float* first = values.data() + i * line;
    double sum = 0.0;
    for (int k = 0; k < count; ++k) {
      before[static_cast<std::size_t>(k)] = first[k * step];
    }
    for (int k = 0; k < std::min(reach, count); ++k) {
      sum += static_cast<double>(before[static_cast<std::size_t>(k)]);
    }
    for (int k = 0; k < count; ++k) {
      const int entering = k + reach;
      const int leaving = k - reach - 1;
      sum += entering < count ? static_cast<double>(before[static_cast<std::size_t>(entering)]) : 0.0;
      sum -= leaving >= 0 ? static_cast<double>(before[static_cast<std::size_t>(leaving)]) : 0.0;
      first[k * step] = static_cast<float>(std::max(sum, 0.0) / (2 * reach + 1));
    }
  }
}

}  // namespace

int text_rim_reach_px(int line_px) { return std::max(static_cast<int>(std::lround(rim_reach * line_px)), 2); }

std::vector<float> text_rim(const std::vector<float>& coverage, int width, int height, int reach_px) {
  std::vector<float> rim = coverage;
  // Two box blurs each way are almost as smooth as a Gaussian, but have finite reach.
  const int half_px = std::max(reach_px / 2, 1);
  for (int round = 0; round < 2; ++round) {
    blur_lines(rim, height, width, width, 1, half_px);
    blur_lines(rim, width, 1, height, width, half_px);
  }
  for (float& value : rim) {
    value = rim_darkness * std::min(rim_gain * value, 1.0F);
  }
  return rim;
}

}  // namespace ergodome
