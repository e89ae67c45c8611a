#include "render/stereo/stereo_eye.h"

#include <algorithm>
#include <cmath>

#include "content/show/stereo_eyes.h"
#include "kernels/core/angles.h"
#include "kernels/objects/light_ray.h"
#include "kernels/spacetime/kerr/frame_boost.h"
#include "kernels/spacetime/shadow/shadow_chart.h"
#include "render/eyes/view_projection.h"

namespace ergodome {

Vector3<double> StereoEye::position(const Vector3<double>& view) const {
  const StereoSettings& stereo = show_.stereo;
  const EyeCameras cameras = eye_cameras(stereo.model);
  if (cameras != EyeCameras::per_direction) {
    return {cameras == EyeCameras::shared ? 0.0 : offset_, 0.0, 0.0};
  }
  const double across = std::hypot(view.x, view.z);
  const double gone = std::cos(one_degree * stereo.fade_to_deg);
  const double ramp = std::clamp((across - gone) / (std::cos(one_degree * stereo.fade_from_deg) - gone), 0.0, 1.0);
  const double share = across > 0.0 ? offset_ * ramp * ramp * (3.0 - 2.0 * ramp) / across : 0.0;
  return {-view.z * share, 0.0, view.x * share};
}

Vector3<double> StereoEye::convergence_turn(const Vector3<double>& view) const {
  const StereoSettings& stereo = show_.stereo;
  const bool turns = eye_cameras(stereo.model) == EyeCameras::per_direction && stereo.convergence > 0.0;
  return turns ? (1.0 / stereo.convergence) * position(view) : Vector3<double>{0.0, 0.0, 0.0};
}

Projection StereoEye::image(const Projection& projection) const {
  return eye_cameras(show_.stereo.model) == EyeCameras::per_direction
             ? projection
             : converged_projection(projection, offset_, show_.stereo.convergence);
}

std::optional<Vector3<double>> StereoEye::sees(const SeenThing& thing) const {
  // Iterates, because an ODS eye's position depends on the direction in which it looks, and the
  // direction in which it sees the thing depends, weakly, on its position.
  const int rounds = eye_cameras(show_.stereo.model) == EyeCameras::per_direction ? 6 : 1;
  constexpr double near_enough = 1e-5;
  Vector3<double> view = {0.0, 0.0, -1.0};
  double off = 0.0;
  for (int round = 0; round < rounds; ++round) {
    const auto seen = seen_by_camera(camera(view), thing);
    if (!seen) {
      return std::nullopt;
    }
    // At direction v, the picture shows the light from direction v - turn. The vector `turn` is
    // perpendicular to v.
    const Vector3<double> turn = convergence_turn(view);
    const Vector3<double> next = normalized(std::sqrt(1.0 + dot(turn, turn)) * seen->view + turn);
    off = rounds > 1 ? std::sqrt(dot(next - view, next - view)) : 0.0;
    view = next;
    if (off < near_enough) {
      break;
    }
  }
  // The iteration need not converge if the baseline exceeds the distance of the thing.
  constexpr double settled = 1e-3;
  return off < settled ? std::optional(view) : std::nullopt;
}

namespace {

//! Minimum radius [M] of both ends of a light path. Closer to the hole there is no closed form that
//! could provide the initial direction.
constexpr double min_r = 2.0;

//! Returns a camera's position. If the camera is on the spin axis, moves the position slightly off
//! it, so that the azimuth stays defined.
Vector3<double> position_beside_axis(EyeCamera eye) {
  constexpr double min_angle = 1e-12;
  eye.theta = std::max(eye.theta, min_angle);
  return position_of(eye);
}

//! Transforms a direction from the frame of the zero-angular-momentum observer to the view's axes
//! of a moving eye.
Vector3<double> seen_in_view(const EyeCamera& eye, const Vector3<double>& direction) {
  const FrameBoost boost = frame_boost(observer_velocity(eye.motion, eye.spacetime, eye.r, eye.theta, eye.velocity));
  double energy = 1.0;
  return in_view(eye, aberrated(FrameBoost{boost.axis, 1.0 / boost.stretch}, direction, energy));
}

}  // namespace

std::optional<SeenPosition> seen_by_camera(const EyeCamera& eye, const SeenThing& thing) {
  const Vector3<double> at = position_beside_axis(eye);
  const LocalFrame frame = local_frame(eye.spacetime, at);
  // Iterates, because the light travel time depends on the position at emission. Things are slower
  // than light, so each round reduces the error.
  const int rounds = thing.moves() ? 8 : 1;
  Vector3<double> position = thing.position;
  RayCorrection correction = {};
  LightRay ray{};
  for (int round = 0; round < rounds; ++round) {
    position = round > 0 ? thing.at(ray.travel_time) : position;
    if (!(dot(position, position) > min_r * min_r) ||
        !light_ray(eye.spacetime, frame, at, position, 1, LightRayParts::way, correction, ray)) {
      return std::nullopt;
    }
  }
  return SeenPosition{seen_in_view(eye, ray.direction), position};
}

Vector3<double> straight_view(const EyeCamera& eye, const Vector3<double>& position) {
  const Vector3<double> at = position_beside_axis(eye);
  return seen_in_view(eye, normalized(in_axes(local_frame(eye.spacetime, at), position - at)));
}

}  // namespace ergodome
