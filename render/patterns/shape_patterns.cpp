#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "kernels/core/angles.h"
#include "render/patterns/dome_label.h"
#include "render/patterns/patterns.h"

namespace ergodome {

namespace {

constexpr Vector3<float> amber = {1.0F, 0.6F, 0.05F};
constexpr Vector3<float> pale = {0.7F, 0.7F, 0.7F};

Vector3<float> grey(double light) {
  const auto value = static_cast<float>(light);
  return {value, value, value};
}

//! Returns the light of lines every 5°, brighter every 10° and 30°. Near the poles, where meridians
//! would merge, there are fewer.
double polar_light(const PatternView& projection, const PatternPlace& place) {
  const DomeSteps steps = dome_steps(projection, place);
  const double elevation = std::abs(place.elevation_deg);
  double light = 0.0;
  for (const auto& [spacing_deg, brightness, width_px, ends_deg] :
       {std::array{5.0, 0.1, 1.2, 60.0}, std::array{10.0, 0.25, 1.5, 80.0}, std::array{30.0, 0.7, 2.0, 90.0}}) {
    light = std::max(light, brightness * line_at(place.elevation_deg, spacing_deg, steps.elevation_deg, width_px));
    if (elevation <= ends_deg) {
      light = std::max(light, brightness * line_at(place.azimuth_deg, spacing_deg, steps.azimuth_deg, width_px));
    }
  }
  return light;
}

std::vector<DomeLabel> polar_labels() {
  std::vector<DomeLabel> labels;
  labels.reserve(128);
  constexpr const char* compass[] = {"N", "NE", "E", "SE", "S", "SW", "W", "NW"};
  for (int i = 0; i < 8; ++i) {
    labels.push_back({compass[i], 45.0 * i, 6.0, i % 2 == 0 ? 6.0 : 3.5, amber});
  }
  for (int azimuth = 0; azimuth < 360; azimuth += 10) {
    if (azimuth % 45 != 0) {
      labels.push_back({fmt::format("{}", azimuth), static_cast<double>(azimuth), 1.8, 1.8, pale});
    }
  }
  for (const int elevation : {-80, -70, -60, -50, -40, -30, -20, -10, 10, 20, 30, 40, 50, 60, 70, 80}) {
    for (int azimuth = 0; azimuth < 360; azimuth += 90) {
      const double beside = azimuth + 2.2 / std::cos(elevation * one_degree);
      labels.push_back({fmt::format("{}", elevation), beside, elevation + 1.6, 1.8, pale});
    }
  }
  return labels;
}

}  // namespace

Picture polar_grid_pattern(const PatternView& projection) {
  const std::vector<LabelStamp> stamps = stamps_of(polar_labels());
  return draw_pattern(projection, 1, [&](const PatternPlace& place) {
    return labelled(grey(polar_light(projection, place)), stamps, place.direction);
  });
}

Picture checker_pattern(const PatternView& projection) {
  return draw_pattern(projection, 4, [](const PatternPlace& place) {
    constexpr double field_deg = 10.0;
    // Each ring has an even number of fields, so that white and black alternate all the way around.
    const double ring = std::min(std::floor(std::abs(place.elevation_deg) / field_deg), 8.0);
    const double pairs = std::max(1.0, std::round(18.0 * std::cos((ring + 0.5) * field_deg * one_degree)));
    const double field = std::floor((place.azimuth_deg + 180.0) / 360.0 * 2.0 * pairs);
    const bool upper = place.elevation_deg >= 0.0;
    return grey(std::fmod(field + ring + (upper ? 0.0 : 1.0), 2.0) < 0.5 ? 0.0 : 1.0);
  });
}

Picture blend_check_pattern(const PatternView& projection) {
  const auto field = static_cast<double>(light_of_value(128.0));
  return draw_pattern(projection, 1, [&](const PatternPlace& place) {
    const DomeSteps steps = dome_steps(projection, place);
    const bool crowded = std::abs(place.elevation_deg) > 75.0;
    const double line = std::max(line_at(place.elevation_deg, 10.0, steps.elevation_deg, 1.5),
                                 line_at(place.azimuth_deg, crowded ? 30.0 : 10.0, steps.azimuth_deg, 1.5));
    return grey(field + (1.0 - field) * line);
  });
}

Picture left_right_pattern(const PatternView& projection, bool left, bool right) {
  constexpr Vector3<float> red = {1.0F, 0.1F, 0.1F};
  constexpr Vector3<float> cyan = {0.0F, 0.8F, 0.9F};
  std::vector<DomeLabel> labels;
  const auto write = [&](const char* text, double across, double up, double height, const Vector3<float>& colour) {
    double azimuth_deg = 0.0;
    double elevation_deg = 0.0;
    dome_place(projection, across, up, azimuth_deg, elevation_deg);
    labels.push_back({text, azimuth_deg, elevation_deg, sheet_degrees(projection, height), colour});
  };
  // Once on a screen, in all four quarters of a dome.
  const bool screen = projection.kind == ProjectionKind::pinhole;
  for (int quarter = 0; quarter < (screen ? 1 : 4); ++quarter) {
    const double across = screen ? 0.5 : 0.25 * quarter;
    const double apart = screen ? 0.25 : 0.06;
    if (left) {
      write("LEFT EYE", across, 0.35, 0.07, red);
      write("L", across - apart, 0.55, 0.12, red);
    }
    if (right) {
      write("RIGHT EYE", across, 0.22, 0.07, cyan);
      write("R", across + apart, 0.55, 0.12, cyan);
    }
  }
  const std::vector<LabelStamp> stamps = stamps_of(labels);
  return draw_pattern(projection, 1, [&](const PatternPlace& place) {
    return labelled(grey(0.15 * polar_light(projection, place)), stamps, place.direction);
  });
}

Picture even_pattern(const PatternView& projection, float light) {
  return draw_pattern(projection, 1, [&](const PatternPlace&) { return grey(static_cast<double>(light)); });
}

}  // namespace ergodome
