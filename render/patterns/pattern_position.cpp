#include "render/patterns/pattern_position.h"

#include <algorithm>
#include <cmath>

#include "kernels/core/angles.h"
#include "kernels/image/color_map.h"
#include "kernels/launch/parallel_for.h"

namespace ergodome {

namespace {

bool is_screen(const Projection& projection) { return projection.kind == ProjectionKind::pinhole; }

//! Converts pixel coordinates of a picture that projectors rotate to those of the position where
//! the pixel is shown.
void shown_at(const PatternView& view, double& x_px, double& y_px) {
  const double right = x_px - 0.5 * view.width_px;
  const double down = y_px - 0.5 * view.height_px;
  if (view.turn_sine != 0.0) {
    x_px = 0.5 * view.width_px + view.turn_cosine * right + view.turn_sine * down;
    y_px = 0.5 * view.height_px + view.turn_cosine * down - view.turn_sine * right;
  }
}

void put_angles(PatternPosition& position) {
  const Vector3<double>& n = position.direction;
  position.azimuth_deg = std::atan2(n.x, -n.z) / one_degree;
  position.elevation_deg = std::atan2(n.y, std::hypot(n.x, n.z)) / one_degree;
}

}  // namespace

PatternView::PatternView(const Projection& projection, double turn)
    : Projection(projection), turn_sine(std::sin(turn)), turn_cosine(std::cos(turn)) {}

PatternPosition pattern_position(const PatternView& projection, double x_px, double y_px) {
  PatternPosition position{};
  position.x_px = x_px;
  position.y_px = y_px;
  double shown_x_px = x_px;
  double shown_y_px = y_px;
  shown_at(projection, shown_x_px, shown_y_px);
  const Vector3<double> shown = direction_from_pixel<double>(projection, shown_x_px, shown_y_px);
  position.direction = {projection.turn_cosine * shown.x + projection.turn_sine * shown.z, shown.y,
                        projection.turn_cosine * shown.z - projection.turn_sine * shown.x};
  put_angles(position);
  if (is_screen(projection)) {
    position.across = x_px / projection.width_px;
    position.up = 1.0 - y_px / projection.height_px;
  } else {
    position.across = (position.azimuth_deg + 180.0) / 360.0;
    position.up = position.elevation_deg / 90.0;
  }
  return position;
}

void dome_position(const PatternView& projection, double across, double up, double& azimuth_deg,
                   double& elevation_deg) {
  if (is_screen(projection)) {
    const PatternPosition position =
        pattern_position(projection, across * projection.width_px, (1.0 - up) * projection.height_px);
    azimuth_deg = position.azimuth_deg;
    elevation_deg = position.elevation_deg;
  } else {
    azimuth_deg = 360.0 * across - 180.0;
    elevation_deg = 90.0 * up;
  }
}

double surface_degrees(const Projection& projection, double part) {
  return is_screen(projection) ? part * projection.height_px * pixel_angle(projection) / one_degree : 90.0 * part;
}

Picture draw_pattern(const PatternView& projection, int samples, const PatternLight& light) {
  Picture picture;
  picture.width = projection.width_px;
  picture.height = projection.height_px;
  picture.tone = {ToneCurve::gamma, 1.0F, 1.0F, 1.0F};
  picture.rgba.assign(4 * static_cast<std::size_t>(picture.width) * static_cast<std::size_t>(picture.height), 0.0F);
  parallel_for(picture.height, 8, [&](int begin, int end) {
    for (int y = begin; y < end; ++y) {
      for (int x = 0; x < picture.width; ++x) {
        const auto coverage = static_cast<float>(image_coverage(projection, x + 0.5, y + 0.5));
        if (!(coverage > 0.0F)) {
          continue;
        }
        Vector3<float> sum = {0.0F, 0.0F, 0.0F};
        for (int j = 0; j < samples; ++j) {
          for (int i = 0; i < samples; ++i) {
            sum = sum + light(pattern_position(projection, x + (i + 0.5) / samples, y + (j + 0.5) / samples));
          }
        }
        const float scale = coverage / static_cast<float>(samples * samples);
        const float rgba[4] = {scale * sum.x, scale * sum.y, scale * sum.z, coverage};
        std::copy_n(rgba, 4, picture.rgba.begin() + 4 * (static_cast<std::ptrdiff_t>(y) * picture.width + x));
      }
    }
  });
  return picture;
}

double line_at(double coordinate, double spacing, double per_px, double width_px) {
  const double apart = std::abs(coordinate - spacing * std::round(coordinate / spacing));
  return std::clamp(0.5 * width_px + 0.5 - apart / std::max(per_px, 1e-12), 0.0, 1.0);
}

DomeSteps dome_steps(const PatternView& projection, const PatternPosition& position) {
  double x_px = position.x_px;
  double y_px = position.y_px;
  shown_at(projection, x_px, y_px);
  // Steps in the picture and steps as shown differ by a rotation, so their combined length is the
  // same.
  const PixelSteps<double> steps = pixel_steps(projection, x_px, y_px);
  const Vector3<double> n = direction_from_pixel<double>(projection, x_px, y_px);
  const double level = std::max(std::hypot(n.x, n.z), 1e-9);
  const Vector3<double> up = {-n.x * n.y / level, level, -n.z * n.y / level};
  const Vector3<double> right = {-n.z / level, 0.0, n.x / level};
  const auto change_deg = [&](const Vector3<double>& way) {
    return std::hypot(dot(way, steps.across), dot(way, steps.down)) / one_degree;
  };
  return {change_deg(up), change_deg(right) / level};
}

float light_of_value(double value) { return srgb_decoded(static_cast<float>(value / 255.0)); }

}  // namespace ergodome
