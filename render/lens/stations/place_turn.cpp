#include "render/lens/stations/place_turn.h"

#include <algorithm>
#include <cmath>

#include "kernels/spacetime/kerr/kerr.h"

namespace ergodome {

namespace {

//! Minimum of the radial scale [M]. It applies near an extremal hole's horizon and inside it, where
//! the distance to r = 1 is too small a scale.
constexpr double least_measure = 0.1;

//! Returns the difference [rad] between the azimuth of ingoing Kerr coordinates and a camera's
//! azimuth. It is 0 inside the horizon, where cameras already use ingoing coordinates.
double outer_turn(Spacetime spacetime, double r) {
  return r > horizon_radius(spacetime) ? ingoing_turn(spacetime, r) : 0.0;
}

glm::dmat3 about_axis(double angle) {
  return {std::cos(angle), std::sin(angle), 0.0, -std::sin(angle), std::cos(angle), 0.0, 0.0, 0.0, 1.0};
}

}  // namespace

bool same_place(const LensPlace& a, const LensPlace& b) {
  constexpr double rounding = 4e-15;
  return std::abs(a.r - b.r) <= rounding * a.r && std::abs(a.theta - b.theta) <= rounding;
}

glm::dmat3 place_turn(Spacetime spacetime, const LensPlace& from, const LensPlace& to) {
  const double tilt = to.theta - from.theta;
  const glm::dmat3 tilted(std::cos(tilt), 0.0, -std::sin(tilt), 0.0, 1.0, 0.0, std::sin(tilt), 0.0, std::cos(tilt));
  return about_axis(outer_turn(spacetime, to.r)) * tilted * about_axis(-outer_turn(spacetime, from.r));
}

double radial_measure(Spacetime spacetime, double r) {
  constexpr double part = 0.25;
  return std::max(r - horizon_radius(spacetime), part * (r - inner_horizon_radius(spacetime)));
}

double place_weight(const LensPlace& first, const LensPlace& second, const LensPlace& place) {
  // In this metric, a radian of θ is as long as a change of r by the distance to r = 1.
  const double scale = 1.0 / std::max(0.5 * (first.r + second.r) - 1.0, least_measure);
  const LensPlace whole = {scale * (second.r - first.r), second.theta - first.theta};
  const double square = whole.r * whole.r + whole.theta * whole.theta;
  const double done = whole.r * scale * (place.r - first.r) + whole.theta * (place.theta - first.theta);
  // The positions of a camera that stands still differ by rounding.
  constexpr double rounding = 1e-12;
  return square > rounding * rounding ? std::clamp(done / square, 0.0, 1.0) : 0.0;
}

CubicMix cubic_mix(const LensPlace& first, const LensPlace& second, const LensPlace& place) {
  const double w = place_weight(first, second, place);
  const LensPlace whole = {second.r - first.r, second.theta - first.theta};
  const LensPlace beside = {place.r - first.r - w * whole.r, place.theta - first.theta - w * whole.theta};
  const auto moved = [&](double along) {
    return LensPlace{beside.r + along * whole.r, beside.theta + along * whole.theta};
  };
  return {{moved(w / (1.0 + 2.0 * w)), moved((w - 1.0) / (3.0 - 2.0 * w))}, w * w * (3.0 - 2.0 * w)};
}

}  // namespace ergodome
