#include "render/passes/overlay/overlay_position.h"

#include <cmath>
#include <limits>

#include "kernels/core/angles.h"

namespace ergodome {

namespace {

//! Maximum elevation at which captions follow circles of constant elevation.
constexpr double steepest_bend = 60.0 * one_degree;
//! On a flat screen, overlays farther from the front than this are omitted, because they are meant
//! for other directions.
constexpr double widest_azimuth_deg = 60.0;
//! Margin on each side of a screen, as a fraction of its angle.
constexpr double screen_margin = 0.03;
//! Maximum distance of an eye from the center of a dome, in radii.
constexpr double farthest_viewer = 0.95;

struct PositionAxes {
  Vector3<double> middle;
  Vector3<double> right;
  Vector3<double> up;
};

PositionAxes axes_of(const DomePosition& position) {
  const double a = one_degree * position.azimuth_deg;
  const double e = one_degree * std::clamp(position.elevation_deg, -90.0, 90.0);
  const double roll = one_degree * position.roll_deg;
  const Vector3<double> middle = {std::cos(e) * std::sin(a), std::sin(e), -std::cos(e) * std::cos(a)};
  const Vector3<double> right = {std::cos(a), 0.0, std::sin(a)};
  const Vector3<double> up = {-std::sin(e) * std::sin(a), std::cos(e), std::sin(e) * std::cos(a)};
  return {middle, std::cos(roll) * right - std::sin(roll) * up, std::sin(roll) * right + std::cos(roll) * up};
}

//! Returns how strongly a caption is bent: the latitude [rad], in the coordinates of its surface,
//! of the circle that the caption's middle line follows. At latitude 0 that is a great circle.
double bend_of(const DomePosition& position) {
  const double e = one_degree * std::clamp(position.elevation_deg, -90.0, 90.0);
  const double size = std::abs(e);
  const double bend = size <= steepest_bend ? size : steepest_bend * (0.5 * pi - size) / (0.5 * pi - steepest_bend);
  return std::copysign(bend, e) * std::cos(one_degree * position.roll_deg);
}

Vector3<float> in_float(const Vector3<double>& v) {
  return {static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z)};
}

Vector3<double> in_double(const Vector3<float>& v) {
  return {static_cast<double>(v.x), static_cast<double>(v.y), static_cast<double>(v.z)};
}

}  // namespace

Projection overlay_projection(const Projection& projection, double offset, double convergence, double distance) {
  const double screen = convergence > 0.0 ? 1.0 / convergence : 0.0;
  const double slope = distance > 0.0 ? offset * (screen - 1.0 / distance) : 0.0;
  Projection own = projection;
  if (projection.kind == ProjectionKind::pinhole) {
    own.pinhole.middle_x -= slope;
  } else if (projection.kind == ProjectionKind::dome_fisheye) {
    own.dome.tilt_sine = 0.0;
    own.dome.tilt_cosine = 1.0;
    own.dome.viewer = {std::clamp(slope, -farthest_viewer, farthest_viewer), 0.0, 0.0};
    own.dome.off_centre = slope != 0.0 ? 1 : 0;
  }
  return own;
}

PlacedOverlay placed_overlay(const Projection& projection, const DomePosition& position, double width, double height) {
  PlacedOverlay placed{position};
  if (projection.kind != ProjectionKind::pinhole) {
    return placed;
  }
  const double azimuth_deg = std::remainder(position.azimuth_deg, 360.0);
  if (std::abs(azimuth_deg) > widest_azimuth_deg) {
    placed.shown = false;
    return placed;
  }
  const Pinhole<double>& screen = projection.pinhole;
  const double roll = one_degree * position.roll_deg;
  const double across = std::abs(std::cos(roll)) * width + std::abs(std::sin(roll)) * height;
  const double upright = std::abs(std::sin(roll)) * width + std::abs(std::cos(roll)) * height;
  // Moves the overlay inside the screen along one axis. The ends of the screen are given as angles,
  // and the overlay's center is clamped between them.
  const auto moved_in = [&](double low, double high, double size, double at_deg) {
    const double from = std::atan(low) + 0.5 * size;
    const double to = std::atan(high) - 0.5 * size;
    return (from < to ? std::clamp(one_degree * at_deg, from, to) : 0.5 * (from + to)) / one_degree;
  };
  const double left = screen.middle_x - screen.half_width;
  const double right = screen.middle_x + screen.half_width;
  const double low = screen.middle_y - screen.half_height;
  const double high = screen.middle_y + screen.half_height;
  constexpr double kept = 1.0 - 2.0 * screen_margin;
  const double room_across = std::atan(right) - std::atan(left);
  const double room_upright = std::atan(high) - std::atan(low);
  placed.scale = std::min({1.0, kept * room_across / across, kept * room_upright / upright});
  const double margin = 2.0 * screen_margin * room_upright;
  placed.position.azimuth_deg = moved_in(left, right, placed.scale * across, azimuth_deg);
  placed.position.elevation_deg = moved_in(low, high, placed.scale * upright + margin, position.elevation_deg);
  return placed;
}

OverlaySurface bent_surface(const DomePosition& position, double width, double height) {
  const PositionAxes axes = axes_of(position);
  const double bend = bend_of(position);
  OverlaySurface surface{};
  surface.shape = OverlayShape::bent;
  surface.across = in_float(axes.right);
  surface.up = in_float(std::sin(bend) * axes.middle + std::cos(bend) * axes.up);
  surface.ahead = in_float(std::cos(bend) * axes.middle - std::sin(bend) * axes.up);
  surface.scale = static_cast<float>(std::cos(bend));
  surface.middle = static_cast<float>(std::atanh(std::sin(bend)));
  surface.width = static_cast<float>(width);
  surface.height = static_cast<float>(height);
  surface.bound_axis = in_float(axes.middle);
  return surface;
}

double widest_bent_surface(const DomePosition& position) { return 1.9 * pi * std::cos(bend_of(position)); }

OverlaySurface flat_surface(const DomePosition& position, double width, double aspect) {
  const PositionAxes axes = axes_of(position);
  OverlaySurface surface{};
  surface.shape = OverlayShape::flat;
  surface.across = in_float(axes.right);
  surface.up = in_float(axes.up);
  surface.ahead = in_float(axes.middle);
  surface.scale = 1.0F;
  surface.width = static_cast<float>(2.0 * std::tan(0.5 * width));
  surface.height = static_cast<float>(2.0 * std::tan(0.5 * width) / aspect);
  surface.bound_axis = surface.ahead;
  return surface;
}

OverlaySurface fisheye_surface(double field_of_view) {
  OverlaySurface surface{};
  surface.shape = OverlayShape::fisheye;
  surface.across = {1.0F, 0.0F, 0.0F};
  surface.up = {0.0F, 1.0F, 0.0F};
  surface.ahead = {0.0F, 0.0F, -1.0F};
  surface.scale = static_cast<float>(0.5 * field_of_view);
  surface.width = surface.height = 1.0F;
  surface.bound_axis = surface.up;
  return surface;
}

Vector3<double> direction_on_surface(const OverlaySurface& surface, double s, double t) {
  const double x = (s - 0.5) * static_cast<double>(surface.width);
  const double y = (0.5 - t) * static_cast<double>(surface.height);
  const Vector3<double> across = in_double(surface.across);
  const Vector3<double> up = in_double(surface.up);
  const Vector3<double> ahead = in_double(surface.ahead);
  if (surface.shape == OverlayShape::flat) {
    const double inverse = 1.0 / std::sqrt(1.0 + x * x + y * y);
    return inverse * (ahead + x * across + y * up);
  }
  const double scale = static_cast<double>(surface.scale);
  const double azimuth = x / scale;
  const double sine = std::tanh(static_cast<double>(surface.middle) + y / scale);
  const double cosine = std::sqrt(1.0 - sine * sine);
  return cosine * std::sin(azimuth) * across + sine * up + cosine * std::cos(azimuth) * ahead;
}

void bound_surface(OverlaySurface& surface, double margin) {
  double half_angle = static_cast<double>(surface.scale);
  if (surface.shape != OverlayShape::fisheye) {
    constexpr int positions = 32;
    double min_cosine = 1.0;
    for (int i = 0; i <= positions; ++i) {
      const double part = static_cast<double>(i) / positions;
      for (const auto& [s, t] :
           {std::pair(part, 0.0), std::pair(part, 1.0), std::pair(0.0, part), std::pair(1.0, part)}) {
        min_cosine = std::min(min_cosine, dot(direction_on_surface(surface, s, t), in_double(surface.bound_axis)));
      }
    }
    // Between the sampled positions, the side may lie slightly further out.
    half_angle = 1.01 * std::acos(std::clamp(min_cosine, -1.0, 1.0));
  }
  const double bound = half_angle + margin;
  surface.bound_cosine = bound < pi ? static_cast<float>(std::cos(bound)) : -2.0F;
}

}  // namespace ergodome
