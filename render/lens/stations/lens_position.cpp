#include "render/lens/stations/lens_position.h"

#include <algorithm>
#include <cmath>

#include "kernels/spacetime/kerr/kerr.h"

namespace ergodome {

namespace {

//! Minimum of the radial scale of position_weight() [M]. It applies near an extremal hole's horizon
//! and inside it, where the distance to r = 1 is too small a scale.
constexpr double min_measure = 0.1;

//! Returns the difference [rad] between the azimuth of ingoing Kerr coordinates and a camera's
//! azimuth. It is 0 inside the horizon, where cameras already use ingoing coordinates.
double outer_turn(Spacetime spacetime, double r) {
  return r > horizon_radius(spacetime) ? ingoing_turn(spacetime, r) : 0.0;
}

glm::dmat3 about_axis(double angle) {
  return {std::cos(angle), std::sin(angle), 0.0, -std::sin(angle), std::cos(angle), 0.0, 0.0, 0.0, 1.0};
}

}  // namespace

bool same_position(const LensPosition& a, const LensPosition& b) {
  constexpr double rounding = 4e-15;
  return std::abs(a.r - b.r) <= rounding * a.r && std::abs(a.theta - b.theta) <= rounding;
}

glm::dmat3 frame_rotation(Spacetime spacetime, const LensPosition& from, const LensPosition& to) {
  const double tilt = to.theta - from.theta;
  const glm::dmat3 tilted(std::cos(tilt), 0.0, -std::sin(tilt), 0.0, 1.0, 0.0, std::sin(tilt), 0.0, std::cos(tilt));
  return about_axis(outer_turn(spacetime, to.r)) * tilted * about_axis(-outer_turn(spacetime, from.r));
}

double radial_measure(Spacetime spacetime, double r) {
  constexpr double part = 0.25;
  return std::max(r - horizon_radius(spacetime), part * (r - inner_horizon_radius(spacetime)));
}

double position_weight(const LensPosition& first, const LensPosition& second, const LensPosition& position) {
  // In this metric, a radian of θ is as long as a change of r by the distance to r = 1.
  const double scale = 1.0 / std::max(0.5 * (first.r + second.r) - 1.0, min_measure);
  const LensPosition whole = {scale * (second.r - first.r), second.theta - first.theta};
  const double square = whole.r * whole.r + whole.theta * whole.theta;
  const double done = whole.r * scale * (position.r - first.r) + whole.theta * (position.theta - first.theta);
  // The positions of a camera that stands still differ by rounding.
  constexpr double rounding = 1e-12;
  return square > rounding * rounding ? std::clamp(done / square, 0.0, 1.0) : 0.0;
}

CubicMix cubic_mix(const LensPosition& first, const LensPosition& second, const LensPosition& position) {
  const double w = position_weight(first, second, position);
  const LensPosition whole = {second.r - first.r, second.theta - first.theta};
  const LensPosition beside = {position.r - first.r - w * whole.r, position.theta - first.theta - w * whole.theta};
  const auto moved = [&](double along) {
    return LensPosition{beside.r + along * whole.r, beside.theta + along * whole.theta};
  };
  return {{moved(w / (1.0 + 2.0 * w)), moved((w - 1.0) / (3.0 - 2.0 * w))}, w * w * (3.0 - 2.0 * w)};
}

}  // namespace ergodome
