#include "calibration/warps/projector_view.h"

#include <cmath>

#include "kernels/core/angles.h"

namespace ergodome {

namespace {

struct SineCosine {
  double sine;
  double cosine;
};

SineCosine of_degrees(double angle_deg) { return {std::sin(one_degree * angle_deg), std::cos(one_degree * angle_deg)}; }

//! Returns the axes after yaw and pitch, before roll.
ProjectorAxes axes_without_roll(const SineCosine& yaw, const SineCosine& pitch) {
  return {{yaw.cosine, 0.0, yaw.sine},
          {-yaw.sine * pitch.sine, pitch.cosine, yaw.cosine * pitch.sine},
          {yaw.sine * pitch.cosine, pitch.sine, -yaw.cosine * pitch.cosine}};
}

}  // namespace

ProjectorAxes axes_of(const Orientation& orientation) {
  const ProjectorAxes level = axes_without_roll(of_degrees(orientation.yaw_deg), of_degrees(orientation.pitch_deg));
  const SineCosine roll = of_degrees(orientation.roll_deg);
  return {roll.cosine * level.right - roll.sine * level.up, roll.cosine * level.up + roll.sine * level.right,
          level.forward};
}

Orientation orientation_of(const ProjectorAxes& axes) {
  const double across = std::hypot(axes.forward.x, axes.forward.z);
  Orientation orientation;
  orientation.pitch_deg = std::atan2(axes.forward.y, across) / one_degree;
  constexpr double straight_up = 1e-9;
  if (across < straight_up) {
    orientation.yaw_deg = std::atan2(axes.right.z, axes.right.x) / one_degree;
    return orientation;
  }
  orientation.yaw_deg = std::atan2(axes.forward.x, -axes.forward.z) / one_degree;
  const ProjectorAxes level = axes_without_roll(of_degrees(orientation.yaw_deg), of_degrees(orientation.pitch_deg));
  orientation.roll_deg = std::atan2(dot(axes.up, level.right), dot(axes.up, level.up)) / one_degree;
  return orientation;
}

Vector3<double> direction_from_raster(const ProjectorAxes& axes, const Frustum& frustum, double x, double y) {
  const double across = std::lerp(std::tan(one_degree * frustum.left_deg), std::tan(one_degree * frustum.right_deg), x);
  const double upwards = std::lerp(std::tan(one_degree * frustum.up_deg), std::tan(one_degree * frustum.down_deg), y);
  return axes.forward + across * axes.right + upwards * axes.up;
}

double growing_angle(const std::vector<double>& polynomial) {
  constexpr int steps = 1800;
  double reached = 0.0;
  for (int i = 0; i <= steps; ++i) {
    const double t = pi * i / steps;
    double slope = 0.0;
    double power = 1.0;
    for (std::size_t k = 0; k < polynomial.size(); ++k, power *= t * t) {
      slope += (2.0 * static_cast<double>(k) + 1.0) * polynomial[k] * power;
    }
    if (!(slope > 0.0)) {
      break;
    }
    reached = t;
  }
  return reached;
}

}  // namespace ergodome
