#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "kernels/core/angles.h"
#include "render/patterns/patterns.h"

namespace ergodome {

namespace {

constexpr double spacing_deg = 15.0;
//! Elevation beyond which only every third line of azimuth continues to the pole.
constexpr double crowded_deg = 75.0;

constexpr Vector3<float> yellow = {1.0F, 0.75F, 0.0F};
constexpr Vector3<float> green = {0.0F, 0.8F, 0.1F};
constexpr Vector3<float> blue = {0.1F, 0.3F, 1.0F};
constexpr Vector3<float> red = {1.0F, 0.05F, 0.05F};
constexpr Vector3<float> white_label = {1.0F, 1.0F, 1.0F};
constexpr Vector3<float> grey_label = {0.35F, 0.35F, 0.35F};

//! Returns the light of the grid's lines at a position.
float grid_light(const PatternView& projection, const PatternPosition& position) {
  const DomeSteps steps = dome_steps(projection, position);
  const bool crowded = std::abs(position.elevation_deg) > crowded_deg;
  const double circles = 0.12 * line_at(position.elevation_deg, spacing_deg, steps.elevation_deg, 1.5);
  const double lines =
      0.12 * line_at(position.azimuth_deg, crowded ? 3.0 * spacing_deg : spacing_deg, steps.azimuth_deg, 1.5);
  // Elevations are between -90° and 90°, so a spacing of 180° yields only the horizon.
  const double horizon = 0.4 * line_at(position.elevation_deg, 180.0, steps.elevation_deg, 2.5);
  const double quarters = 0.4 * line_at(position.azimuth_deg, 90.0, steps.azimuth_deg, 2.0);
  return static_cast<float>(std::max({circles, lines, horizon, quarters}));
}

}  // namespace

std::vector<DomeLabel> orientation_labels() {
  std::vector<DomeLabel> labels = {{"FRONT", 0.0, 6.5, 6.0, yellow},        {"RIGHT", 90.0, 6.5, 6.0, green},
                                   {"BACK", 180.0, 6.5, 6.0, blue},         {"LEFT", -90.0, 6.5, 6.0, red},
                                   {"ZENITH", 0.0, 90.0, 5.0, white_label}, {"NADIR", 0.0, -90.0, 5.0, white_label}};
  for (int azimuth = -165; azimuth <= 180; azimuth += 15) {
    if (azimuth % 90 != 0) {
      labels.push_back({fmt::format("{}", azimuth), static_cast<double>(azimuth), 2.5, 2.5, grey_label});
    }
  }
  for (int elevation = -75; elevation <= 75; elevation += 15) {
    for (const double quarter : {0.0, 90.0, 180.0, -90.0}) {
      if (elevation != 0) {
        // The label of a circle is beside the line of azimuth, just above the circle.
        labels.push_back({fmt::format("{}", elevation), quarter + 3.0 / std::cos(elevation * one_degree),
                          elevation + 2.0, 2.5, grey_label});
      }
    }
  }
  return labels;
}

Picture orientation_pattern(const PatternView& projection) {
  const std::vector<LabelStamp> stamps = stamps_of(orientation_labels());
  return draw_pattern(projection, 1, [&](const PatternPosition& position) {
    const float line = grid_light(projection, position);
    return labelled({line, line, line}, stamps, position.direction);
  });
}

}  // namespace ergodome
