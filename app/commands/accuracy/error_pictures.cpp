#include "app/commands/accuracy/error_pictures.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "kernels/image/color_map.h"
#include "render/accuracy/measurement.h"
#include "render/output/image_writer.h"

namespace ergodome {

namespace {

constexpr float nothing_grey = 0.16F;

std::vector<std::uint8_t> colours_of(const ErrorMap& map, double minimum, double maximum) {
  std::vector<std::uint8_t> rgb;
  rgb.reserve(3 * map.error.size());
  for (const float error : map.error) {
    const double position =
        std::log(std::max(static_cast<double>(error), minimum) / minimum) / std::log(maximum / minimum);
    const Vector3<float> colour = std::isnan(error) ? Vector3<float>{nothing_grey, nothing_grey, nothing_grey}
                                                    : heat_color(static_cast<float>(std::min(position, 1.0)));
    for (const float part : {colour.x, colour.y, colour.z}) {
      rgb.push_back(static_cast<std::uint8_t>(std::lround(255.0F * part)));
    }
  }
  return rgb;
}

const Measurement* max_exact(const AccuracyAxis& axis, const std::string& method) {
  const Measurement* best = nullptr;
  for (const Measurement& choice : axis.choices) {
    if (choice.method == method && (best == nullptr || choice.error.p99 < best->error.p99)) {
      best = &choice;
    }
  }
  return best;
}

}  // namespace

void draw_error_pictures(AccuracyReport& report, double max_px, const std::filesystem::path& folder) {
  for (AccuracyAxis& axis : report.axes) {
    const bool light = axis.unit == ErrorUnit::light;
    std::set<const Measurement*> chosen;
    for (const EqualErrorRow& row : compare_at(axis, light ? 0.01 : max_px, FrameCost::ready)) {
      chosen.insert(row.choice != nullptr ? row.choice : max_exact(axis, row.method));
    }
    int number = 0;
    for (Measurement& choice : axis.choices) {
      const bool wanted = choice.best_ready || choice.best_anew || chosen.contains(&choice);
      if (!wanted || choice.map.error.empty()) {
        continue;
      }
      choice.picture = fmt::format("error-{}-{}.png", axis.name, ++number);
      write_png(folder / choice.picture,
                colours_of(choice.map, light ? min_drawn_light : min_drawn_px, light ? max_drawn_light : max_drawn_px),
                choice.map.width, choice.map.height);
    }
  }
}

}  // namespace ergodome
