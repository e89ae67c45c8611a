#include "render/lens/place_turn.h"

#include <algorithm>
#include <cmath>

namespace ergodome {

namespace {

//! How far an ingoing principal null ray turns about the axis on its way from infinity to r [rad]: the integral of a / Δ.
double principal_turn(double spin, double r) {
  const double half = std::sqrt(std::max(0.0, (1.0 - spin) * (1.0 + spin)));  // (r_+ - r_-) / 2
  const double x = half / (r - 1.0);
  return spin / (r - 1.0) * (x > 1e-4 ? std::atanh(x) / x : 1.0 + x * x / 3.0);
}

glm::dmat3 about_axis(double angle) {
  return {std::cos(angle), std::sin(angle), 0.0, -std::sin(angle), std::cos(angle), 0.0, 0.0, 0.0, 1.0};
}

}  // namespace

glm::dmat3 place_turn(double spin, const LensPlace& from, const LensPlace& to) {
  const double tilt = to.theta - from.theta;
  const glm::dmat3 tilted(std::cos(tilt), 0.0, -std::sin(tilt), 0.0, 1.0, 0.0, std::sin(tilt), 0.0, std::cos(tilt));
  return about_axis(-principal_turn(spin, to.r)) * tilted * about_axis(principal_turn(spin, from.r));
}

double place_weight(const LensPlace& first, const LensPlace& second, const LensPlace& place) {
  const auto height = [](const LensPlace& p) { return std::log(p.r - 1.0); };
  const double along_r = height(second) - height(first);
  const double along_theta = second.theta - first.theta;
  const double square = along_r * along_r + along_theta * along_theta;
  const double done = along_r * (height(place) - height(first)) + along_theta * (place.theta - first.theta);
  return square > 0.0 ? std::clamp(done / square, 0.0, 1.0) : 0.0;
}

}  // namespace ergodome
