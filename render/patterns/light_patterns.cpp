#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "render/patterns/dome_label.h"
#include "render/patterns/patterns.h"

namespace ergodome {

namespace {

constexpr int steps = 17;
constexpr Vector3<float> pale_label = {0.35F, 0.35F, 0.35F};

Vector3<float> grey_of(double value) {
  const float light = light_of_value(value);
  return {light, light, light};
}

//! A band of the sheet, with the display values at its left and right ends.
struct Ramp {
  double bottom;
  double top;
  double first_value;
  double last_value;
  bool smooth;
  double ground_value;  //!< of the sheet beside its fields
};

constexpr Ramp ramps[] = {{0.12, 0.28, 0.0, 256.0, false, 0.0},
                          {0.30, 0.40, 0.0, 255.0, true, 0.0},
                          {0.52, 0.64, 0.0, 16.0, false, 0.0},
                          {0.74, 0.86, 239.0, 255.0, false, 255.0}};
//! The part of the sheet that ramps fill, symmetric about the front.
constexpr double ramp_left = 0.1;
constexpr double ramp_right = 0.9;

double value_on(const Ramp& ramp, double part) {
  const double at = ramp.smooth ? part : std::min(std::floor(part * steps), steps - 1.0) / (steps - 1.0);
  return std::min(ramp.first_value + at * (ramp.last_value - ramp.first_value), 255.0);
}

Vector3<float> ramp_light(const PatternPlace& place) {
  for (const Ramp& ramp : ramps) {
    // A bright ground extends beyond its fields, so that it shows whether the brightest field can
    // be distinguished from it.
    const double margin = ramp.ground_value > 0.0 ? 0.03 : 0.0;
    if (place.up < ramp.bottom - margin || place.up >= ramp.top + margin) {
      continue;
    }
    const double part = (place.across - ramp_left) / (ramp_right - ramp_left);
    const bool field = part >= 0.0 && part < 1.0 && place.up >= ramp.bottom && place.up < ramp.top;
    return grey_of(field ? value_on(ramp, part) : ramp.ground_value);
  }
  return {0.0F, 0.0F, 0.0F};
}

//! Returns labels with the value under each field.
std::vector<DomeLabel> ramp_labels(const PatternView& projection) {
  std::vector<DomeLabel> labels;
  for (const Ramp& ramp : ramps) {
    for (int i = 0; i < steps && !ramp.smooth; ++i) {
      const double part = (i + 0.5) / steps;
      DomeLabel label;
      label.text = fmt::format("{:.0f}", value_on(ramp, part));
      dome_place(projection, ramp_left + part * (ramp_right - ramp_left), ramp.bottom - 0.05, label.azimuth_deg,
                 label.elevation_deg);
      label.height_deg = sheet_degrees(projection, 0.016);
      label.colour = pale_label;
      labels.push_back(label);
    }
  }
  return labels;
}

}  // namespace

Picture grey_ramp_pattern(const PatternView& projection) {
  const std::vector<LabelStamp> stamps = stamps_of(ramp_labels(projection));
  return draw_pattern(projection, 2,
                      [&](const PatternPlace& place) { return labelled(ramp_light(place), stamps, place.direction); });
}

Picture colour_bar_pattern(const PatternView& projection) {
  // In order of decreasing luminance, as in television.
  constexpr Vector3<float> bars[] = {{1.0F, 1.0F, 1.0F}, {1.0F, 1.0F, 0.0F}, {0.0F, 1.0F, 1.0F}, {0.0F, 1.0F, 0.0F},
                                     {1.0F, 0.0F, 1.0F}, {1.0F, 0.0F, 0.0F}, {0.0F, 0.0F, 1.0F}, {0.0F, 0.0F, 0.0F}};
  const double times_round = projection.kind == ProjectionKind::pinhole ? 1.0 : 4.0;
  return draw_pattern(projection, 2, [&](const PatternPlace& place) {
    const double turn = place.across * times_round + 0.5 * (times_round - 1.0);
    const auto bar = static_cast<int>(8.0 * (turn - std::floor(turn)));
    // On a screen the bars fill everything; on a dome they end where they become too narrow to
    // distinguish.
    const double up = std::abs(place.up);
    if (up > 0.85 && times_round > 1.0) {
      return Vector3<float>{0.0F, 0.0F, 0.0F};
    }
    return (up < 0.5 ? light_of_value(0.75 * 255.0) : 1.0F) * bars[std::min(bar, 7)];
  });
}

}  // namespace ergodome
