#include "render/output/pattern_picture.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "kernels/launch/parallel_for.h"
#include "kernels/projection/pixel_measure.h"
#include "render/output/caption.h"

namespace ergodome {

namespace {

constexpr double degree = 3.14159265358979323846 / 180.0;
constexpr int font_px = 48;
constexpr double spacing_deg = 15.0;
//! Beyond this elevation only every third line of azimuth goes on to the pole.
constexpr double crowded_deg = 75.0;

constexpr Vector3<float> yellow = {1.0F, 0.75F, 0.0F};
constexpr Vector3<float> green = {0.0F, 0.8F, 0.1F};
constexpr Vector3<float> blue = {0.1F, 0.3F, 1.0F};
constexpr Vector3<float> red = {1.0F, 0.05F, 0.05F};
constexpr Vector3<float> white = {1.0F, 1.0F, 1.0F};
constexpr Vector3<float> grey = {0.35F, 0.35F, 0.35F};

//! A label as pixels look for it: a flat picture that touches the sphere in its middle.
struct Stamp {
  Vector3<double> middle;
  Vector3<double> right;
  Vector3<double> up;
  double scale;          //!< pixels of the text per unit of length
  double cosine_beyond;  //!< of the angle from its middle that it stays within
  TextImage text;
  Vector3<float> colour;
};

Stamp stamp_of(const PatternLabel& label) {
  const double azimuth = label.azimuth_deg * degree;
  const double elevation = label.elevation_deg * degree;
  const Vector3<double> ahead = {std::sin(azimuth), 0.0, -std::cos(azimuth)};
  Stamp stamp;
  stamp.middle = std::cos(elevation) * ahead + Vector3<double>{0.0, std::sin(elevation), 0.0};
  stamp.right = {std::cos(azimuth), 0.0, std::sin(azimuth)};
  stamp.up = cross(stamp.right, stamp.middle);
  stamp.text = text_image(label.text, font_px);
  // Capitals fill a box of their own height.
  stamp.scale = std::max(stamp.text.height, 1) / (label.height_deg * degree);
  stamp.cosine_beyond = std::cos(std::atan(0.5 * std::hypot(stamp.text.width, stamp.text.height) / stamp.scale));
  stamp.colour = label.colour;
  return stamp;
}

//! How much of a pixel in direction n a label covers.
float covered_by(const Stamp& stamp, const Vector3<double>& n) {
  const double ahead = dot(n, stamp.middle);
  if (!(ahead > stamp.cosine_beyond)) {
    return 0.0F;
  }
  const double x = 0.5 * stamp.text.width + stamp.scale * dot(n, stamp.right) / ahead - 0.5;
  const double y = 0.5 * stamp.text.height - stamp.scale * dot(n, stamp.up) / ahead - 0.5;
  const int column = static_cast<int>(std::floor(x));
  const int row = static_cast<int>(std::floor(y));
  const auto at = [&](int i, int j) {
    const bool inside = i >= 0 && j >= 0 && i < stamp.text.width && j < stamp.text.height;
    return inside ? stamp.text.coverage[static_cast<std::size_t>(j) * static_cast<std::size_t>(stamp.text.width) +
                                        static_cast<std::size_t>(i)]
                  : 0.0F;
  };
  const auto across = static_cast<float>(x - column);
  const auto down = static_cast<float>(y - row);
  return (1.0F - down) * ((1.0F - across) * at(column, row) + across * at(column + 1, row)) +
         down * ((1.0F - across) * at(column, row + 1) + across * at(column + 1, row + 1));
}

//! How much of a pixel a line covers that is `width_px` wide, at every `spacing` of a coordinate.
double line_at(double coordinate, double spacing, double per_px, double width_px) {
  const double apart = std::abs(coordinate - spacing * std::round(coordinate / spacing));
  return std::clamp(0.5 * width_px + 0.5 - apart / std::max(per_px, 1e-12), 0.0, 1.0);
}

//! Light of the grid's lines at a pixel.
double grid_light(const Vector3<double>& n, const PixelSteps<double>& steps) {
  const double level = std::max(std::hypot(n.x, n.z), 1e-9);
  const double elevation_deg = std::atan2(n.y, level) / degree;
  const double azimuth_deg = std::atan2(n.x, -n.z) / degree;
  const Vector3<double> up = {-n.x * n.y / level, level, -n.z * n.y / level};
  const Vector3<double> right = {-n.z / level, 0.0, n.x / level};
  const auto change_deg = [&](const Vector3<double>& way) {
    return std::hypot(dot(way, steps.across), dot(way, steps.down)) / degree;
  };
  const double rise_deg = change_deg(up);
  const double turn_deg = change_deg(right) / level;
  const bool crowded = std::abs(elevation_deg) > crowded_deg;
  const double circles = 0.12 * line_at(elevation_deg, spacing_deg, rise_deg, 1.5);
  const double lines = 0.12 * line_at(azimuth_deg, crowded ? 3.0 * spacing_deg : spacing_deg, turn_deg, 1.5);
  // Once in 180°: the horizon. The poles are points.
  const double horizon = 0.4 * line_at(elevation_deg, 180.0, rise_deg, 2.5);
  const double quarters = 0.4 * line_at(azimuth_deg, 90.0, turn_deg, 2.0);
  return std::max({circles, lines, horizon, quarters});
}

}  // namespace

std::vector<PatternLabel> pattern_labels() {
  std::vector<PatternLabel> labels = {{"FRONT", 0.0, 6.5, 6.0, yellow},  {"RIGHT", 90.0, 6.5, 6.0, green},
                                      {"BACK", 180.0, 6.5, 6.0, blue},   {"LEFT", -90.0, 6.5, 6.0, red},
                                      {"ZENITH", 0.0, 90.0, 5.0, white}, {"NADIR", 0.0, -90.0, 5.0, white}};
  for (int azimuth = -165; azimuth <= 180; azimuth += 15) {
    if (azimuth % 90 != 0) {
      labels.push_back({fmt::format("{}", azimuth), static_cast<double>(azimuth), 2.5, 2.5, grey});
    }
  }
  for (int elevation = -75; elevation <= 75; elevation += 15) {
    for (const double quarter : {0.0, 90.0, 180.0, -90.0}) {
      if (elevation != 0) {
        // Beside the line, on top of the circle.
        labels.push_back(
            {fmt::format("{}", elevation), quarter + 3.0 / std::cos(elevation * degree), elevation + 2.0, 2.5, grey});
      }
    }
  }
  return labels;
}

Picture orientation_pattern(const Projection& projection) {
  std::vector<Stamp> stamps;
  for (const PatternLabel& label : pattern_labels()) {
    stamps.push_back(stamp_of(label));
  }
  Picture picture;
  picture.width = projection.width_px;
  picture.height = projection.height_px;
  picture.rgba.resize(4 * static_cast<std::size_t>(picture.width) * static_cast<std::size_t>(picture.height));
  parallel_for(picture.height, 8, [&](int begin, int end) {
    for (int y = begin; y < end; ++y) {
      for (int x = 0; x < picture.width; ++x) {
        const double coverage = image_coverage(projection, x + 0.5, y + 0.5);
        if (!(coverage > 0.0)) {
          continue;
        }
        const Vector3<double> n = direction_from_pixel(projection, x + 0.5, y + 0.5);
        const auto line = static_cast<float>(grid_light(n, pixel_steps(projection, x + 0.5, y + 0.5)));
        Vector3<float> light = {line, line, line};
        for (const Stamp& stamp : stamps) {
          const float part = covered_by(stamp, n);
          light = (1.0F - part) * light + part * stamp.colour;
        }
        const auto inside = static_cast<float>(coverage);
        const float rgba[4] = {inside * light.x, inside * light.y, inside * light.z, inside};
        std::copy_n(rgba, 4, picture.rgba.begin() + 4 * (static_cast<std::ptrdiff_t>(y) * picture.width + x));
      }
    }
  });
  return picture;
}

}  // namespace ergodome
