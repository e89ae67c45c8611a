#include "tests/hard_cases/contact_sheets.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <string>
#include <string_view>

#include "kernels/image/color_map.h"
#include "kernels/spacetime/shadow/critical_curve.h"
#include "render/output/image_writer.h"
#include "render/passes/overlay/caption_image.h"
#include "tests/hard_cases/miss.h"
#include "tests/hard_cases/ray_sets.h"
#include "tests/hard_cases/sky_window.h"

namespace ergodome::test {

namespace {

constexpr int side_px = 112;
constexpr int gap_px = 6;
constexpr int words_px = 236;
constexpr int head_px = 30;
constexpr int rows_a_contact_sheet = 10;
//! The range of the color scale for errors: the decimal logarithm of pixels of a 4096² dome.
constexpr double min_log = -7.0;
constexpr double max_log = 1.0;

using Colour = std::array<std::uint8_t, 3>;

constexpr Colour dark = {0, 0, 0};
constexpr Colour lost = {255, 0, 255};
constexpr Colour wrong_side = {255, 40, 30};

struct Way {
  const char* name;
  SeenSky (*see)(const CameraState& camera_state, const Directions& rays);
};

constexpr Way ways[] = {
    {"polar angles",
     [](const CameraState& p, const Directions& n) { return by_rays(p, n, TraceMethod::baseline_rk34, 1e-7); }},
    {"published grid", by_quadtree},
    {"our grid", [](const CameraState& p, const Directions& n) { return by_live_grid(p, n, Nodes::in_double); }},
    {"our rays, double",
     [](const CameraState& p, const Directions& n) { return by_rays(p, n, TraceMethod::taylor, 1e-12); }}};

constexpr int contact_sheet_width_px = words_px + static_cast<int>(std::size(ways)) * (side_px + gap_px);

class ContactSheet {
 public:
  explicit ContactSheet(int rows)
      : height_px_(head_px + rows * (side_px + gap_px)),
        rgb_(3UL * static_cast<std::size_t>(contact_sheet_width_px) * static_cast<std::size_t>(height_px_), 255) {}

  void put(int x, int y, const Colour& colour) {
    if (x >= 0 && x < contact_sheet_width_px && y >= 0 && y < height_px_) {
      std::copy(colour.begin(), colour.end(), rgb_.begin() + 3L * (static_cast<long>(y) * contact_sheet_width_px + x));
    }
  }

  //! Writes black text centered in a rectangle.
  void write(const std::string& words, int left, int top, int width, int height) {
    CaptionType type;
    type.line_px = 17;
    type.width_px = width;
    type.color = {0.0, 0.0, 0.0};
    const OverlayImage image = set_caption(words, type).image;
    const int from_x = left + (width - image.width) / 2;
    const int from_y = top + (height - image.height) / 2;
    for (int y = 0; y < image.height; ++y) {
      for (int x = 0; x < image.width; ++x) {
        // A caption has a soft dark rim, for bright skies. Here only the letters are used, because
        // the rim would blur the text.
        const double cover = image.texels[4UL * (static_cast<std::size_t>(y) * static_cast<std::size_t>(image.width) +
                                                 static_cast<std::size_t>(x)) +
                                          3] /
                             65535.0;
        const auto grey = static_cast<std::uint8_t>(255.0 * (1.0 - std::pow(cover, 3.0)));
        if (grey < 250) {
          put(from_x + x, from_y + y, {grey, grey, grey});
        }
      }
    }
  }

  void save(const std::filesystem::path& file) const { write_png(file, rgb_, contact_sheet_width_px, height_px_); }

 private:
  int height_px_;
  std::vector<std::uint8_t> rgb_;
};

//! Returns directions in a window around the part of the camera's sky that makes a case hard: the
//! whole hole, its edge, or the direction of the case's first ray.
Directions window_of(const HardCase& hard, const CameraStation& camera) {
  const ShadowChart chart = make_shadow_chart(camera);
  if (hard.rays == whole_sky) {
    // If the shadow fills the whole window, the window is moved to its edge.
    constexpr double across = 2.4;
    constexpr double gamma = 0.7;
    const double edge = edge_polar_angle(camera, chart, gamma);
    return square_window(edge < 0.45 * across || dot(chart.centre, {-1.0, 0.0, 0.0}) < 0.7
                             ? Vector3<double>{-1.0, 0.0, 0.0}
                             : chart_direction<double>(chart, std::cos(edge), std::sin(edge), gamma),
                         across, side_px);
  }
  const Vector3<double> first = hard.rays(camera).front();
  if (!std::string(hard.name).starts_with("Edge") && !std::string(hard.name).starts_with("FarAwayAtTheEdge") &&
      !std::string(hard.name).starts_with("LightPaths")) {
    return square_window(first, 0.1, side_px);
  }
  const double gamma = chart_position_angle(chart, first);
  const double edge = edge_polar_angle(camera, chart, gamma);
  const double distance = std::abs(chart_polar_angle(chart, first) - edge);
  return square_window(chart_direction<double>(chart, std::cos(edge), std::sin(edge), gamma), 4.0 * distance, side_px);
}

Colour colour_of(const ExactRay& exact, const SeenSky& seen, std::size_t i) {
  if (seen.status[i] == static_cast<double>(LightEnd::unresolved)) {
    return lost;
  }
  const bool bright = seen.status[i] == static_cast<double>(LightEnd::sky);
  if (bright != exact.bright) {
    return wrong_side;
  }
  if (!bright) {
    return dark;
  }
  const Vector3<double> sky = {seen.sky[0][i], seen.sky[1][i], seen.sky[2][i]};
  const double miss_px = std::max(displacement(exact, sky - exact.sky) / dome_pixel, 1e-30);
  // Rounds errors to half powers of ten: steps of color are easier to read than a gradient, and
  // compress better.
  const double step = std::round(2.0 * std::log10(miss_px)) / 2.0;
  const Vector3<float> heat = heat_color(static_cast<float>((step - min_log) / (max_log - min_log)));
  const auto level = [](float value) { return static_cast<std::uint8_t>(std::lround(255.0F * value)); };
  return {level(heat.x), level(heat.y), level(heat.z)};
}

//! Splits a name into words: "OnTheAxis" becomes "On The Axis".
std::string in_words(std::string_view name) {
  std::string words;
  for (const char letter : name) {
    if (!words.empty() && std::isupper(static_cast<unsigned char>(letter)) != 0) {
      words += ' ';
    }
    words += letter;
  }
  return words;
}

void draw_case(const HardCase& hard, int top, ContactSheet& sheet) {
  sheet.write(in_words(hard.name), 0, top, words_px, side_px);
  const CameraStation camera = station_at(hard.camera_state);
  const Directions rays = window_of(hard, camera);
  const std::vector<ExactRay> exact = exact_rays(camera, rays);
  for (std::size_t way = 0; way < std::size(ways); ++way) {
    const bool no_reference = hard.allowed.grid_px == not_asked;
    const bool skipped = no_reference || (way == 1 && hard.allowed.quadtree_px == not_asked);
    const int left = words_px + static_cast<int>(way) * (side_px + gap_px);
    if (skipped) {
      sheet.write(no_reference ? "no reference" : "-", left, top, side_px, side_px);
      continue;
    }
    const SeenSky seen = ways[way].see(hard.camera_state, rays);
    for (std::size_t i = 0; i < rays.size(); ++i) {
      sheet.put(left + static_cast<int>(i) % side_px, top + static_cast<int>(i) / side_px,
                colour_of(exact[i], seen, i));
    }
  }
}

}  // namespace

void write_contact_sheets(const std::filesystem::path& folder) {
  const std::vector<HardCase>& cases = hard_cases();
  for (std::size_t first = 0; first < cases.size(); first += rows_a_contact_sheet) {
    const std::size_t count = std::min<std::size_t>(rows_a_contact_sheet, cases.size() - first);
    ContactSheet sheet(static_cast<int>(count));
    for (std::size_t way = 0; way < std::size(ways); ++way) {
      sheet.write(ways[way].name, words_px + static_cast<int>(way) * (side_px + gap_px), 0, side_px + gap_px, head_px);
    }
    for (std::size_t i = 0; i < count; ++i) {
      draw_case(cases[first + i], head_px + static_cast<int>(i) * (side_px + gap_px), sheet);
    }
    sheet.save(folder / fmt::format("hard-cases-{}.png", first / rows_a_contact_sheet + 1));
  }
}

}  // namespace ergodome::test
