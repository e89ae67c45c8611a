#include "render/passes/overlay/caption_image.h"

#include <pango/pangocairo.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <memory>

#include "render/output/text_image.h"

namespace ergodome {

namespace {

//! Pango substitutes other installed fonts for scripts that the first font lacks.
constexpr const char* font_family = "DejaVu Sans, Sans";

struct Unref {
  void operator()(void* object) const noexcept { g_object_unref(object); }
};
template <class T>
using Pango = std::unique_ptr<T, Unref>;

struct Destroy {
  void operator()(cairo_t* context) const noexcept { cairo_destroy(context); }
  void operator()(cairo_surface_t* surface) const noexcept { cairo_surface_destroy(surface); }
  void operator()(PangoFontDescription* font) const noexcept { pango_font_description_free(font); }
  void operator()(PangoFontMetrics* metrics) const noexcept { pango_font_metrics_unref(metrics); }
  void operator()(cairo_font_options_t* options) const noexcept { cairo_font_options_destroy(options); }
  void operator()(gchar* text) const noexcept { g_free(text); }
};
template <class T>
using Held = std::unique_ptr<T, Destroy>;

//! Returns valid UTF-8 for Pango, without control characters except line breaks and tabs.
std::string clean_text(const std::string& text) {
  const Held<gchar> valid(
      g_utf8_make_valid(text.data(), static_cast<gssize>(std::min(text.size(), max_caption_bytes))));
  std::string clean;
  for (const gchar* at = valid.get(); *at != '\0'; at = g_utf8_next_char(at)) {
    const gunichar letter = g_utf8_get_char(at);
    if (letter == '\n' || letter == '\t' || !g_unichar_iscntrl(letter)) {
      clean.append(at, static_cast<std::size_t>(g_utf8_next_char(at) - at));
    }
  }
  return clean;
}

Held<PangoFontDescription> font_of(PangoContext* context, int line_px) {
  Held<PangoFontDescription> font(pango_font_description_new());
  pango_font_description_set_family(font.get(), font_family);
  constexpr double trial_px = 1000.0;
  pango_font_description_set_absolute_size(font.get(), trial_px * PANGO_SCALE);
  const Held<PangoFontMetrics> metrics(pango_context_get_metrics(context, font.get(), nullptr));
  const int height = metrics ? pango_font_metrics_get_height(metrics.get()) : 0;
  // Without any installed font, the height is 0; avoids a division by zero.
  const double of_size = height > 0 ? height / (trial_px * PANGO_SCALE) : 1.2;
  pango_font_description_set_absolute_size(font.get(), std::max(line_px / of_size, 1.0) * PANGO_SCALE);
  return font;
}

//! Lines laid out by Pango, without hinting, so that glyph positions do not depend on the size.
struct Lines {
  Pango<PangoContext> context;
  Pango<PangoLayout> layout;
};

Lines lay_out(const std::string& text, const CaptionType& type) {
  Lines lines;
  // Pango caches the fonts of a thread, so each thread uses its own default font map.
  lines.context.reset(pango_font_map_create_context(pango_cairo_font_map_get_default()));
  const Held<cairo_font_options_t> options(cairo_font_options_create());
  cairo_font_options_set_antialias(options.get(), CAIRO_ANTIALIAS_GRAY);
  cairo_font_options_set_hint_style(options.get(), CAIRO_HINT_STYLE_NONE);
  cairo_font_options_set_hint_metrics(options.get(), CAIRO_HINT_METRICS_OFF);
  pango_cairo_context_set_font_options(lines.context.get(), options.get());
  pango_context_set_round_glyph_positions(lines.context.get(), 0);
  lines.layout.reset(pango_layout_new(lines.context.get()));
  const Held<PangoFontDescription> font = font_of(lines.context.get(), type.line_px);
  pango_layout_set_font_description(lines.layout.get(), font.get());
  pango_layout_set_text(lines.layout.get(), text.data(), static_cast<int>(text.size()));
  pango_layout_set_width(lines.layout.get(), static_cast<int>(std::clamp(type.width_px, 1.0, 1e5) * PANGO_SCALE));
  pango_layout_set_wrap(lines.layout.get(), PANGO_WRAP_WORD_CHAR);
  pango_layout_set_alignment(lines.layout.get(), PANGO_ALIGN_CENTER);
  return lines;
}

//! Coverage of pixels by letters, 0 to 1; empty on failure.
struct Letters {
  int width = 0;
  int height = 0;
  std::vector<float> coverage{};
  bool too_large = false;
};

Letters draw_letters(PangoLayout* layout, int margin_px) {
  PangoRectangle ink;
  PangoRectangle box;
  pango_layout_get_pixel_extents(layout, &ink, &box);
  if (ink.width <= 0 || ink.height <= 0) {
    return {};
  }
  // The image is centered on the middle of the lines, and wide enough for glyphs that extend beyond
  // the lines.
  const int beside = std::max({0, box.x - ink.x, ink.x + ink.width - box.x - box.width});
  const int above = std::max({0, box.y - ink.y, ink.y + ink.height - box.y - box.height});
  Letters letters{box.width + 2 * (beside + margin_px), box.height + 2 * (above + margin_px)};
  if (letters.width > longest_overlay_px || letters.height > longest_overlay_px) {
    letters.too_large = true;
    return letters;
  }
  const Held<cairo_surface_t> surface(cairo_image_surface_create(CAIRO_FORMAT_A8, letters.width, letters.height));
  const Held<cairo_t> context(cairo_create(surface.get()));
  cairo_move_to(context.get(), margin_px + beside - box.x, margin_px + above - box.y);
  pango_cairo_show_layout(context.get(), layout);
  cairo_surface_flush(surface.get());
  if (cairo_status(context.get()) != CAIRO_STATUS_SUCCESS) {
    return {};
  }
  const unsigned char* rows = cairo_image_surface_get_data(surface.get());
  const int stride = cairo_image_surface_get_stride(surface.get());
  for (int y = 0; y < letters.height; ++y) {
    for (int x = 0; x < letters.width; ++x) {
      letters.coverage.push_back(static_cast<float>(rows[static_cast<std::ptrdiff_t>(y) * stride + x]) / 255.0F);
    }
  }
  return letters;
}

bool has_font(const std::string& text) {
  constexpr CaptionType any{32, 1e5};
  return pango_layout_get_unknown_glyphs_count(lay_out(text, any).layout.get()) == 0;
}

//! Returns the strength of the dark rim around letters of a color. It is lower for dark letters,
//! which a full rim would make unreadable.
float rim_strength(const std::array<double, 3>& color) {
  constexpr double bright = 0.2;
  return static_cast<float>(std::clamp(*std::ranges::max_element(color) / bright, 0.0, 1.0));
}

}  // namespace

std::string letters_without_font(const std::string& text) {
  const std::string clean = clean_text(text);
  std::string missing;
  // Checks texts letter by letter only if a glyph is missing, which is rare.
  if (clean.empty() || has_font(clean)) {
    return missing;
  }
  for (const gchar* at = clean.c_str(); *at != '\0'; at = g_utf8_next_char(at)) {
    const std::string letter(at, static_cast<std::size_t>(g_utf8_next_char(at) - at));
    if (missing.find(letter) == std::string::npos && !has_font(letter)) {
      missing += letter;
    }
  }
  return missing;
}

CaptionImage set_caption(const std::string& text, const CaptionType& type) {
  const std::string clean = clean_text(text);
  CaptionImage caption;
  if (clean.empty()) {
    return caption;
  }
  const Lines lines = lay_out(clean, type);
  const int reach_px = text_rim_reach_px(type.line_px);
  const Letters letters = draw_letters(lines.layout.get(), reach_px + 2);
  caption.too_large = letters.too_large;
  if (std::ranges::none_of(letters.coverage, [](float part) { return part > 0.0F; })) {
    return caption;
  }
  const std::vector<float> rim = text_rim(letters.coverage, letters.width, letters.height, reach_px);
  const float strength = rim_strength(type.color);
  std::vector<float> rgba;
  rgba.reserve(4 * rim.size());
  for (std::size_t i = 0; i < rim.size(); ++i) {
    const float letter = letters.coverage[i];
    for (const double part : type.color) {
      rgba.push_back(letter * static_cast<float>(part));
    }
    rgba.push_back(letter + (1.0F - letter) * strength * rim[i]);
  }
  caption.image = make_overlay_image(letters.width, letters.height, rgba);
  return caption;
}

}  // namespace ergodome
