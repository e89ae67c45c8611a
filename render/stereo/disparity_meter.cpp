#include "render/stereo/disparity_meter.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "kernels/core/angles.h"
#include "kernels/core/vector3.h"
#include "kernels/spacetime/shadow/shadow_chart.h"

namespace ergodome {

namespace {

bool is_shown(const Projection& image, double x, double y) {
  return x >= 0.0 && x <= image.width_px && y >= 0.0 && y <= image.height_px && image_coverage(image, x, y) > 0.0;
}

//! Returns whether the direction of the viewer's right in the image differs between parts of the
//! image, so that horizontal disparities are not along rows.
bool turns_its_rows(const Projection& image) {
  return image.kind == ProjectionKind::dome_fisheye || image.kind == ProjectionKind::cube;
}

//! Returns the scale of an image for horizontal separations at a view direction [px/rad].
double pixels_per_turn(const Projection& image, const Vector3<double>& view) {
  constexpr double small = 1e-4;
  const double level = std::hypot(view.x, view.z);
  const Vector3<double> across =
      level > 0.0 ? (1.0 / level) * Vector3<double>{-view.z, 0.0, view.x} : Vector3<double>{1.0, 0.0, 0.0};
  double x = 0.0;
  double y = 0.0;
  if (!pixel_from_direction(image, view, x, y)) {
    return 0.0;
  }
  double minimum = std::numeric_limits<double>::infinity();
  for (const double side : {-small, small}) {
    double beside_x = 0.0;
    double beside_y = 0.0;
    if (pixel_from_direction(image, normalized(view + side * across), beside_x, beside_y)) {
      // Uses the shorter of the two distances, because the other one may cross a seam of the image.
      minimum = std::min(minimum, std::hypot(beside_x - x, beside_y - y) / small);
    }
  }
  return std::isfinite(minimum) ? minimum : 0.0;
}

//! Returns the minimum and maximum of a number over all things and over the samples of a surface
//! (`layer`), without the surface's outliers.
template <class Shift>
std::pair<double, double> bounds_of(const std::vector<Shift>& things, const std::vector<Shift>& layer,
                                    double Shift::*number) {
  double minimum = std::numeric_limits<double>::infinity();
  double maximum = -minimum;
  const auto take = [&](double value) {
    minimum = std::min(minimum, value);
    maximum = std::max(maximum, value);
  };
  for (const Shift& thing : things) {
    take(thing.*number);
  }
  if (!layer.empty()) {
    std::vector<double> values;
    values.reserve(layer.size());
    for (const Shift& direction : layer) {
      values.push_back(direction.*number);
    }
    std::ranges::sort(values);
    const auto left_out = static_cast<std::size_t>(DisparityMeter::outlying_share * static_cast<double>(values.size()));
    take(values[left_out]);
    take(values[values.size() - 1 - left_out]);
  }
  return {minimum, maximum};
}

}  // namespace

bool DisparityMeter::shows(const Vector3<double>& view) const {
  double x = 0.0;
  double y = 0.0;
  return pixel_from_direction(screen_, view, x, y) && is_shown(screen_, x, y);
}

std::optional<DisparityMeter::Shift> DisparityMeter::shift_of(const Vector3<double>& left,
                                                              const Vector3<double>& right) const {
  double x[2];
  double y[2];
  if (!pixel_from_direction(images_[0], left, x[0], y[0]) || !pixel_from_direction(images_[1], right, x[1], y[1]) ||
      !(is_shown(images_[0], x[0], y[0]) || is_shown(images_[1], x[1], y[1]))) {
    return std::nullopt;
  }
  // Directions in which a viewer sees the two pixels on the screen, whose projection is that of an
  // image without convergence.
  const Vector3<double> from = direction_from_pixel(screen_, x[0], y[0]);
  const Vector3<double> to = direction_from_pixel(screen_, x[1], y[1]);
  const double turn = std::atan2(to.x, -to.z) - std::atan2(from.x, -from.z);
  // Azimuths converge towards the zenith, so differences of azimuth are reduced by the cosine of
  // the elevation.
  const double level = 0.5 * (std::hypot(from.x, from.z) + std::hypot(to.x, to.z));
  const double turned = level * std::remainder(turn, 360.0 * one_degree);
  double pixels = screen_.left < 0.0 ? x[1] - x[0] : x[0] - x[1];
  if (turns_its_rows(screen_)) {
    pixels = turned * pixels_per_turn(screen_, normalized(from + to));
  } else if (wraps_around(screen_)) {
    pixels = std::remainder(pixels, screen_.width_px);
  }
  // NaN cannot be sorted.
  return std::isfinite(pixels) && std::isfinite(turned) ? std::optional(Shift{pixels, 60.0 / one_degree * turned})
                                                        : std::nullopt;
}

void DisparityMeter::add(const Vector3<double>& left, const Vector3<double>& right) {
  if (const auto shift = shift_of(left, right)) {
    things_.push_back(*shift);
  }
}

void DisparityMeter::add_of_layer(const Vector3<double>& left, const Vector3<double>& right) {
  if (const auto shift = shift_of(left, right)) {
    layer_.push_back(*shift);
  }
}

std::optional<Disparity> DisparityMeter::result() const {
  const auto [min_px, max_px] = bounds_of(things_, layer_, &Shift::pixels);
  const auto [min_arcmin, max_arcmin] = bounds_of(things_, layer_, &Shift::arcmin);
  return things_.empty() && layer_.empty() ? std::nullopt
                                           : std::optional(Disparity{min_px, max_px, min_arcmin, max_arcmin});
}

}  // namespace ergodome
