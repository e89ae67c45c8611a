#include "render/patterns/patterns.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "kernels/core/angles.h"
#include "render/patterns/dome_label.h"

namespace ergodome {

namespace {

constexpr int steps = 17;
constexpr Vector3<float> pale_label = {0.35F, 0.35F, 0.35F};

Vector3<float> grey_of(double value) {
  const float light = light_of_value(value);
  return {light, light, light};
}

//! A horizontal band of a pattern (PatternPosition's coordinates), with the display values at its
//! left and right ends.
struct Ramp {
  double bottom;
  double top;
  double first_value;
  double last_value;
  bool smooth;
  double ground_value;  //!< display value of the background beside the fields
};

constexpr Ramp ramps[] = {{0.12, 0.28, 0.0, 256.0, false, 0.0},
                          {0.30, 0.40, 0.0, 255.0, true, 0.0},
                          {0.52, 0.64, 0.0, 16.0, false, 0.0},
                          {0.74, 0.86, 239.0, 255.0, false, 255.0}};
//! Range of PatternPosition::across that ramps fill; it is symmetric about the front.
constexpr double ramp_left = 0.1;
constexpr double ramp_right = 0.9;

double value_on(const Ramp& ramp, double part) {
  const double at = ramp.smooth ? part : std::min(std::floor(part * steps), steps - 1.0) / (steps - 1.0);
  return std::min(ramp.first_value + at * (ramp.last_value - ramp.first_value), 255.0);
}

Vector3<float> ramp_light(const PatternPosition& position) {
  for (const Ramp& ramp : ramps) {
    // A bright background extends beyond its fields, so that it shows whether the brightest field
    // can be distinguished from it.
    const double margin = ramp.ground_value > 0.0 ? 0.03 : 0.0;
    if (position.up < ramp.bottom - margin || position.up >= ramp.top + margin) {
      continue;
    }
    const double part = (position.across - ramp_left) / (ramp_right - ramp_left);
    const bool field = part >= 0.0 && part < 1.0 && position.up >= ramp.bottom && position.up < ramp.top;
    return grey_of(field ? value_on(ramp, part) : ramp.ground_value);
  }
  return {0.0F, 0.0F, 0.0F};
}

//! Returns labels below the fields with their display values.
std::vector<DomeLabel> ramp_labels(const PatternView& projection) {
  std::vector<DomeLabel> labels;
  for (const Ramp& ramp : ramps) {
    for (int i = 0; i < steps && !ramp.smooth; ++i) {
      const double part = (i + 0.5) / steps;
      DomeLabel label;
      label.text = fmt::format("{:.0f}", value_on(ramp, part));
      dome_position(projection, ramp_left + part * (ramp_right - ramp_left), ramp.bottom - 0.05, label.azimuth_deg,
                    label.elevation_deg);
      label.height_deg = surface_degrees(projection, 0.016);
      label.colour = pale_label;
      labels.push_back(label);
    }
  }
  return labels;
}

}  // namespace

Picture grey_ramp_pattern(const PatternView& projection) {
  const std::vector<LabelStamp> stamps = stamps_of(ramp_labels(projection));
  return draw_pattern(projection, 2, [&](const PatternPosition& position) {
    return labelled(ramp_light(position), stamps, position.direction);
  });
}

Picture colour_bar_pattern(const PatternView& projection) {
  // In order of decreasing luminance, as in television.
  constexpr Vector3<float> bars[] = {{1.0F, 1.0F, 1.0F}, {1.0F, 1.0F, 0.0F}, {0.0F, 1.0F, 1.0F}, {0.0F, 1.0F, 0.0F},
                                     {1.0F, 0.0F, 1.0F}, {1.0F, 0.0F, 0.0F}, {0.0F, 0.0F, 1.0F}, {0.0F, 0.0F, 0.0F}};
  const double times_round = projection.kind == ProjectionKind::pinhole ? 1.0 : 4.0;
  return draw_pattern(projection, 2, [&](const PatternPosition& position) {
    const double turn = position.across * times_round + 0.5 * (times_round - 1.0);
    const auto bar = static_cast<int>(8.0 * (turn - std::floor(turn)));
    // On a flat screen the bars fill the whole picture; on a dome they end where they become too
    // narrow to distinguish.
    const double up = std::abs(position.up);
    if (up > 0.85 && times_round > 1.0) {
      return Vector3<float>{0.0F, 0.0F, 0.0F};
    }
    return (up < 0.5 ? light_of_value(0.75 * 255.0) : 1.0F) * bars[std::min(bar, 7)];
  });
}

namespace {

constexpr Vector3<float> amber = {1.0F, 0.6F, 0.05F};
constexpr Vector3<float> pale = {0.7F, 0.7F, 0.7F};

Vector3<float> grey(double light) {
  const auto value = static_cast<float>(light);
  return {value, value, value};
}

//! Returns the light of lines every 5°, which are brighter every 10° and 30°. Near the poles there
//! are fewer meridians, because they would merge.
double polar_light(const PatternView& projection, const PatternPosition& position) {
  const DomeSteps steps = dome_steps(projection, position);
  const double elevation = std::abs(position.elevation_deg);
  double light = 0.0;
  for (const auto& [spacing_deg, brightness, width_px, ends_deg] :
       {std::array{5.0, 0.1, 1.2, 60.0}, std::array{10.0, 0.25, 1.5, 80.0}, std::array{30.0, 0.7, 2.0, 90.0}}) {
    light = std::max(light, brightness * line_at(position.elevation_deg, spacing_deg, steps.elevation_deg, width_px));
    if (elevation <= ends_deg) {
      light = std::max(light, brightness * line_at(position.azimuth_deg, spacing_deg, steps.azimuth_deg, width_px));
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
  return draw_pattern(projection, 1, [&](const PatternPosition& position) {
    return labelled(grey(polar_light(projection, position)), stamps, position.direction);
  });
}

Picture checker_pattern(const PatternView& projection) {
  return draw_pattern(projection, 4, [](const PatternPosition& position) {
    constexpr double field_deg = 10.0;
    // Each ring has an even number of fields, so that white and black alternate all the way around.
    const double ring = std::min(std::floor(std::abs(position.elevation_deg) / field_deg), 8.0);
    const double pairs = std::max(1.0, std::round(18.0 * std::cos((ring + 0.5) * field_deg * one_degree)));
    const double field = std::floor((position.azimuth_deg + 180.0) / 360.0 * 2.0 * pairs);
    const bool upper = position.elevation_deg >= 0.0;
    return grey(std::fmod(field + ring + (upper ? 0.0 : 1.0), 2.0) < 0.5 ? 0.0 : 1.0);
  });
}

Picture blend_check_pattern(const PatternView& projection) {
  const auto field = static_cast<double>(light_of_value(128.0));
  return draw_pattern(projection, 1, [&](const PatternPosition& position) {
    const DomeSteps steps = dome_steps(projection, position);
    const bool crowded = std::abs(position.elevation_deg) > 75.0;
    const double line = std::max(line_at(position.elevation_deg, 10.0, steps.elevation_deg, 1.5),
                                 line_at(position.azimuth_deg, crowded ? 30.0 : 10.0, steps.azimuth_deg, 1.5));
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
    dome_position(projection, across, up, azimuth_deg, elevation_deg);
    labels.push_back({text, azimuth_deg, elevation_deg, surface_degrees(projection, height), colour});
  };
  // The texts are drawn once on a flat screen, and in four directions on a dome.
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
  return draw_pattern(projection, 1, [&](const PatternPosition& position) {
    return labelled(grey(0.15 * polar_light(projection, position)), stamps, position.direction);
  });
}

Picture even_pattern(const PatternView& projection, float light) {
  return draw_pattern(projection, 1, [&](const PatternPosition&) { return grey(static_cast<double>(light)); });
}

}  // namespace ergodome
