#include "render/frame/disparity_meter.h"

#include <algorithm>
#include <cmath>

#include "kernels/core/angles.h"
#include "kernels/core/vector3.h"

namespace ergodome {

namespace {

bool is_shown(const Projection& image, double x, double y) {
  return x >= 0.0 && x <= image.width_px && y >= 0.0 && y <= image.height_px && image_coverage(image, x, y) > 0.0;
}

}  // namespace

bool DisparityMeter::shows(const Vector3<double>& view) const {
  double x = 0.0;
  double y = 0.0;
  return pixel_from_direction(screen_, view, x, y) && is_shown(screen_, x, y);
}

void DisparityMeter::add(const Vector3<double>& left, const Vector3<double>& right) {
  double x[2];
  double y[2];
  if (!pixel_from_direction(images_[0], left, x[0], y[0]) || !pixel_from_direction(images_[1], right, x[1], y[1]) ||
      !(is_shown(images_[0], x[0], y[0]) || is_shown(images_[1], x[1], y[1]))) {
    return;
  }
  double pixels = x[1] - x[0];
  if (wraps_around(images_[0])) {
    pixels = std::remainder(pixels, images_[0].width_px);
  }
  // Where a viewer sees them: through an image that does not converge.
  const Vector3<double> from = direction_from_pixel(screen_, x[0], y[0]);
  const Vector3<double> to = direction_from_pixel(screen_, x[1], y[1]);
  const double turn = std::atan2(to.x, -to.z) - std::atan2(from.x, -from.z);
  // Azimuths lie closer towards the zenith.
  const double level = 0.5 * (std::hypot(from.x, from.z) + std::hypot(to.x, to.z));
  const double turned = 60.0 / one_degree * level * std::remainder(turn, 360.0 * one_degree);
  if (!any_) {
    disparity_ = {pixels, pixels, turned, turned};
    any_ = true;
  }
  disparity_ = {std::min(disparity_.least_px, pixels), std::max(disparity_.greatest_px, pixels),
                std::min(disparity_.least_arcmin, turned), std::max(disparity_.greatest_arcmin, turned)};
}

}  // namespace ergodome
