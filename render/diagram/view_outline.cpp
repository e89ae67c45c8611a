#include "render/diagram/view_outline.h"

#include <algorithm>
#include <cmath>

#include "kernels/core/angles.h"
#include "kernels/spacetime/kerr/frame_boost.h"
#include "render/eyes/view_projection.h"

namespace ergodome {

namespace {

constexpr int parts_of_side = 12;

//! Transforms directions from an eye's view axes to pseudo-Cartesian axes, in the frame of an
//! observer without angular momentum.
class ViewTurn {
 public:
  explicit ViewTurn(const EyeCamera& eye)
      : eye_(eye), boost_(frame_boost(observer_velocity(eye.motion, eye.spacetime, eye.r, eye.theta, eye.velocity))) {
    const double sine = std::sin(eye.theta);
    const double cosine = std::cos(eye.theta);
    const double sine_phi = std::sin(eye.phi);
    const double cosine_phi = std::cos(eye.phi);
    axes_[0] = {sine * cosine_phi, sine * sine_phi, cosine};
    axes_[1] = {cosine * cosine_phi, cosine * sine_phi, -sine};
    axes_[2] = {-sine_phi, cosine_phi, 0.0};
  }

  [[nodiscard]] Vector3<double> operator()(const Vector3<double>& view) const {
    const auto& m = eye_.frame_from_view;
    double part[3];
    for (int i = 0; i < 3; ++i) {
      part[i] = m[i][0] * view.x + m[i][1] * view.y + m[i][2] * view.z;
    }
    double energy = 1.0;
    const Vector3<double> n = aberrated(boost_, Vector3<double>{part[0], part[1], part[2]}, energy);
    return n.x * axes_[0] + n.y * axes_[1] + n.z * axes_[2];
  }

 private:
  const EyeCamera& eye_;
  FrameBoost boost_;
  Vector3<double> axes_[3];
};

}  // namespace

ViewOutline view_outline(const ViewSettings& view, const EyeCamera& eye) {
  constexpr int width_px = 1024;
  const Projection projection = make_projection(view, width_px, 0.0);
  const ViewTurn turned(eye);
  ViewOutline outline;
  const bool flat = projection.kind == ProjectionKind::pinhole;
  const Vector3<double> forward = turned({0.0, 0.0, -1.0});
  const auto add = [&](double x, double y, bool corner) {
    const Vector3<double> unit =
        turned(direction_from_pixel(projection, x * projection.width_px, y * projection.height_px));
    // Points of a flat screen are moved to distance 1 along the forward direction. Points more than
    // about 73° from that direction, on very wide screens or by aberration, stay closer.
    const Vector3<double> direction = flat ? (1.0 / std::max(dot(unit, forward), 0.3)) * unit : unit;
    outline.border.push_back(direction);
    if (corner) {
      outline.corners.push_back(direction);
    }
  };
  if (projection.kind == ProjectionKind::dome_fisheye) {
    constexpr int parts = 4 * parts_of_side;
    for (int i = 0; i <= parts; ++i) {
      const double angle = full_turn * i / parts;
      add(0.5 + 0.499 * std::cos(angle), 0.5 + 0.499 * std::sin(angle), i % parts_of_side == 0 && i < parts);
    }
  } else if (projection.kind == ProjectionKind::pinhole || projection.kind == ProjectionKind::cylinder ||
             (projection.kind == ProjectionKind::equirectangular && !wraps_around(projection))) {
    constexpr double corner[5][2] = {{0.0, 0.0}, {1.0, 0.0}, {1.0, 1.0}, {0.0, 1.0}, {0.0, 0.0}};
    for (int side = 0; side < 4; ++side) {
      for (int i = 0; i < parts_of_side; ++i) {
        const double share = static_cast<double>(i) / parts_of_side;
        const auto& from = corner[side];
        const auto& to = corner[side + 1];
        add(from[0] + share * (to[0] - from[0]), from[1] + share * (to[1] - from[1]), i == 0);
      }
    }
    outline.border.push_back(outline.border.front());
  }
  return outline;
}

Vector3<double> forward_of(const EyeCamera& eye) { return ViewTurn(eye)({0.0, 0.0, -1.0}); }

}  // namespace ergodome
