#include "app/navigation/path_return.h"

#include <algorithm>
#include <cmath>

#include "app/navigation/comfort.h"
#include "content/timeline/key_curve.h"
#include "kernels/core/angles.h"
#include "kernels/spacetime/kerr/kerr.h"

namespace ergodome {

namespace {

constexpr double longest_s = 30.0;

//! Decreases from 1 to 0 on [0, 1], with vanishing first and second derivatives at both ends.
double fading(double s) { return 1.0 - eased(s); }

//! Starts at 0 with slope 1 and ends at 0 with vanishing first and second derivatives.
double coasting(double s) { return s * (1.0 + s * s * (-6.0 + s * (8.0 - 3.0 * s))); }

//! The maximum slope of `fading`.
constexpr double steepest = 1.875;

//! Of the two axis-angle vectors of a rotation, returns the one closer to another vector.
glm::dvec3 nearest_turn(const glm::dvec3& turn, const glm::dvec3& to) {
  const double angle = glm::length(turn);
  if (!(angle > 0.0)) {
    return turn;
  }
  const glm::dvec3 other = turn * ((angle - 2.0 * pi) / angle);
  return glm::distance(other, to) < glm::distance(turn, to) ? other : turn;
}

double height_above(double horizon_r, double r) { return std::max(r - horizon_r, 1e-9); }

}  // namespace

PathReturn::Offset PathReturn::offset(const CameraPlacement& camera, const CameraPose& path) {
  const glm::dquat frame = spherical_frame(path.theta, path.phi);
  const glm::dvec3 outward(1.0, 0.0, 0.0);
  const glm::dquat direction = shortest_rotation(outward, glm::conjugate(frame) * camera.towards);
  const glm::dquat view =
      glm::conjugate(direction) * glm::conjugate(frame) * camera.view * glm::conjugate(path.orientation);
  return {turn_of(direction), turn_of(glm::normalize(view))};
}

PathReturn::PathReturn(const FlightSpace& space, const FlightSettings& settings, const CameraPlacement (&camera)[2],
                       const CameraPose (&path)[2], double seconds)
    : space_(space),
      horizon_r_(horizon_radius(space.spacetime())),
      start_(offset(camera[1], path[1])),
      coasting_r_(camera[1].r),
      radial_speed_((camera[1].r - camera[0].r) / seconds) {
  const double fastest_turn = one_degree * settings.comfort.turn_deg_s;
  const Offset before = offset(camera[0], path[0]);
  // If an offset is near half a turn, its axis is unreliable, and so is the rate of the offset; the
  // limit keeps such a rate harmless.
  rate_ = {shortened((start_.direction - nearest_turn(before.direction, start_.direction)) / seconds, fastest_turn),
           shortened((start_.view - nearest_turn(before.view, start_.view)) / seconds, fastest_turn)};
  const double turn = glm::length(start_.direction) + glm::length(start_.view);
  const double rise = std::abs(std::log(height_above(horizon_r_, camera[1].r) / height_above(horizon_r_, path[1].r)));
  const double needed_s = steepest * std::max(turn / fastest_turn, rise / (2.0 * settings.max_speed));
  duration_s_ = std::clamp(needed_s, settings.return_s, std::max(longest_s, settings.return_s));
}

CameraPlacement PathReturn::advance(double seconds, const CameraPose& path) {
  elapsed_s_ = std::min(elapsed_s_ + seconds, duration_s_);
  if (arrived()) {
    return placement_of(path);
  }
  const double s = elapsed_s_ / duration_s_;
  const double left = fading(s);
  // The coasting speed decreases to 1/e in a quarter of the duration.
  coasting_r_ = space_.moved_radius(coasting_r_, radial_speed_ * std::exp(-4.0 * elapsed_s_ / duration_s_), seconds);
  const glm::dvec3 direction = left * start_.direction + (coasting(s) * duration_s_) * rate_.direction;
  const glm::dvec3 view = left * start_.view + (coasting(s) * duration_s_) * rate_.view;
  const glm::dquat frame = spherical_frame(path.theta, path.phi) * rotation(direction);
  const double height =
      std::pow(height_above(horizon_r_, coasting_r_), left) * std::pow(height_above(horizon_r_, path.r), 1.0 - left);
  return {horizon_r_ + height, glm::normalize(frame * glm::dvec3(1.0, 0.0, 0.0)),
          glm::normalize(frame * rotation(view) * path.orientation)};
}

}  // namespace ergodome
