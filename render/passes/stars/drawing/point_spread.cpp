#include "render/passes/stars/drawing/point_spread.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace ergodome {

PointSpreads::PointSpreads(double sigma_px, double reach_px) : reach_px_(reach_px) {
  if (!(sigma_px > 0.0)) {
    return;
  }
  // Cubics between steps of sqrt(2) σ / 16 are accurate to 1e-6.
  constexpr double steps = 16.0;
  const double narrower = 1.0 / (sigma_px * std::numbers::sqrt2);
  steps_a_px_ = std::max(static_cast<int>(std::ceil(steps * narrower)), 1);
  columns_ = static_cast<std::size_t>(2.0 * reach_px) + 1;
  const double total = std::erf(reach_px * narrower);
  table_.reserve(2 * columns_ * static_cast<std::size_t>(steps_a_px_ + 1));
  for (int step = 0; step <= steps_a_px_; ++step) {
    const auto x_of = [&](std::size_t column) {
      return (static_cast<double>(step) / steps_a_px_ + static_cast<double>(column) - reach_px) * narrower;
    };
    for (std::size_t column = 0; column < columns_; ++column) {
      table_.push_back(static_cast<float>(0.5 + 0.5 * std::erf(x_of(column)) / total));
    }
    for (std::size_t column = 0; column < columns_; ++column) {
      const double density = std::exp(-x_of(column) * x_of(column)) * std::numbers::inv_sqrtpi / total;
      table_.push_back(static_cast<float>(density * narrower / steps_a_px_));
    }
  }
}

void PointSpreads::spread(double middle_px, PointSpread& spread) const {
  if (steps_a_px_ == 0) {
    spread.first = static_cast<int>(std::floor(middle_px));
    spread.count = 1;
    spread.part[0] = 1.0F;
    return;
  }
  const double begin_px = middle_px - reach_px_;
  spread.first = static_cast<int>(std::floor(begin_px));
  spread.count = static_cast<int>(std::floor(middle_px + reach_px_)) - spread.first + 1;
  const float at = static_cast<float>(spread.first + 1 - begin_px) * static_cast<float>(steps_a_px_);
  const int step = std::min(static_cast<int>(at), steps_a_px_ - 1);
  // Hermite's weights of values and slopes at both ends of the step
  const float t = at - static_cast<float>(step);
  const float rest = 1.0F - t;
  const float upper = t * t * (3.0F - 2.0F * t);
  const float lower_slope = t * rest * rest;
  const float upper_slope = -t * t * rest;
  const float* const value = table_.data() + 2 * columns_ * static_cast<std::size_t>(step);
  const float* const slope = value + columns_;
  const int last = spread.count - 1;
  float before = 0.0F;
  for (int i = 0; i < last; ++i) {
    const float low = value[i];
    const float high = value[2 * columns_ + i];
    const float up_to = low + upper * (high - low) + lower_slope * slope[i] + upper_slope * slope[2 * columns_ + i];
    spread.part[static_cast<std::size_t>(i)] = up_to - before;
    before = up_to;
  }
  spread.part[static_cast<std::size_t>(last)] = 1.0F - before;
}

}  // namespace ergodome
