#include "render/passes/stars/drawing/point_spread.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace ergodome {

namespace {

//! The error function, interpolated by cubics between equidistant nodes, accurate to 1e-6. Each
//! point of light needs about ten values.
class ErrorFunction {
 public:
  ErrorFunction() {
    for (int i = 0; i <= steps; ++i) {
      const double x = static_cast<double>(i) / steps_a_unit - reach;
      entries_[static_cast<std::size_t>(i)] = {
          static_cast<float>(std::erf(x)),
          static_cast<float>(std::exp(-x * x) * std::numbers::inv_sqrtpi * 2.0 / steps_a_unit)};
    }
  }

  float operator()(float x) const {
    const float position = std::clamp((x + reach) * steps_a_unit, 0.0F, steps - 1e-3F);
    const int i = static_cast<int>(position);
    const float t = position - static_cast<float>(i);
    const Entry& low = entries_[static_cast<std::size_t>(i)];
    const Entry& high = entries_[static_cast<std::size_t>(i) + 1];
    const float rise = high.value - low.value;
    const float bend = low.slope + high.slope - 2.0F * rise;
    return low.value + t * (low.slope + t * (rise - low.slope - bend + t * bend));
  }

 private:
  static constexpr float reach = 4.0F;
  static constexpr int steps_a_unit = 16;
  static constexpr int steps = 128;
  struct Entry {
    float value;
    float slope;  //!< derivative of the value, per distance between table entries
  };
  std::array<Entry, steps + 1> entries_{};
};

}  // namespace

// NOLINTNEXTLINE(cppcoreguidelines-pro-type-member-init): most of the parts are never read
PointSpread::PointSpread(double middle_px, double sigma_px, double reach_px) {
  static const ErrorFunction error_function;
  if (!(sigma_px > 0.0)) {
    first = static_cast<int>(std::floor(middle_px));
    count = 1;
    part[0] = 1.0F;
    return;
  }
  first = static_cast<int>(std::floor(middle_px - reach_px));
  count = static_cast<int>(std::floor(middle_px + reach_px)) - first + 1;
  const double narrower = 1.0 / (sigma_px * std::numbers::sqrt2);
  const auto integral = [&](double x) {
    return error_function(static_cast<float>(std::clamp(x - middle_px, -reach_px, reach_px) * narrower));
  };
  const float begin = integral(first);
  float from = begin;
  for (int i = 0; i < count; ++i) {
    const float to = integral(first + i + 1);
    part[static_cast<std::size_t>(i)] = to - from;
    from = to;
  }
  const float scale = 1.0F / (from - begin);
  std::for_each_n(part.begin(), count, [&](float& each) { each *= scale; });
}

}  // namespace ergodome
