#include "render/output/auto_exposure.h"

#include <algorithm>
#include <cmath>

#include "kernels/launch/work_counter.h"

namespace ergodome {

namespace {
constexpr float darkest = 1e-5F;
}  // namespace

void LightMeter::add(const Picture& picture) {
  static WorkCounter counter("meter_light");
  const WorkScope work(counter, static_cast<long>(picture.width) * picture.height);
  for (std::size_t i = 0; i + 3 < picture.rgba.size(); i += 4) {
    const float* pixel = picture.rgba.data() + i;
    const float luminance = 0.2126F * pixel[0] + 0.7152F * pixel[1] + 0.0722F * pixel[2];
    // Ignore the shadow and pixels outside the image.
    if (pixel[3] > 0.5F && std::isfinite(luminance)) {
      sum_ += static_cast<double>(std::log2(std::max(luminance, darkest)));
      count_ += 1.0;
    }
  }
}

double LightMeter::middle_light() const { return count_ > 0.0 ? std::exp2(sum_ / count_) : 0.0; }

void AutoExposure::go_on_from(double stops) {
  started_ = true;
  stops_ = stops;
}

double AutoExposure::follow(double middle_light, double seconds) {
  const double wished = middle_light > 0.0 ? std::log2(settings_.target / middle_light) : stops_;
  const double goal = std::clamp(wished, settings_.least_stops, settings_.most_stops);
  const double part =
      !started_ || !(settings_.adapt_s > 0.0) ? 1.0 : 1.0 - std::exp(-std::max(seconds, 0.0) / settings_.adapt_s);
  started_ = true;
  stops_ += part * (goal - stops_);
  return stops_;
}

}  // namespace ergodome
