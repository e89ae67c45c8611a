#include "app/navigation/steered_motion.h"

#include <algorithm>
#include <cmath>

#include "app/navigation/comfort.h"

namespace ergodome {

namespace {

//! Default speed without `faster`, as a fraction of the maximum.
constexpr double usual_part = 0.5;

//! Fractions of the angular acceleration for looking and for going around; the rest is for their
//! coupling.
constexpr double head_part = 0.4;
constexpr double around_part = 0.3;

//! Returns a rotation rate that covers the remaining rotation `left` [rad]: at most `maximum`, and
//! slow enough near the end to come to rest with `acceleration`.
glm::dvec3 braked(const glm::dvec3& left, double maximum, double acceleration) {
  constexpr double delay_s = 0.3;
  const double distance = glm::length(left);
  if (!(distance > 0.0)) {
    return glm::dvec3(0.0);
  }
  return left * (std::min({maximum, distance / delay_s, std::sqrt(1.2 * acceleration * distance)}) / distance);
}

double limited(double value, double maximum) {
  return std::isfinite(value) ? std::clamp(value, -maximum, maximum) : 0.0;
}

//! Returns a turn about the view's axes: up, right and clockwise are about x, -y and -z.
glm::dvec3 head_turn(const Steering& s) { return {s.pitch, -s.yaw, -s.roll}; }

}  // namespace

Steering limited_steering(const Steering& s, double maximum) {
  return {limited(s.right, maximum),   limited(s.up, maximum),
          limited(s.forward, maximum), limited(s.yaw, maximum),
          limited(s.pitch, maximum),   limited(s.roll, maximum),
          limited(s.zoom, maximum),    std::max(limited(s.faster, 1.0), 0.0)};
}

void SteeredMotion::add_mouse(const Steering& amounts) {
  mouse_turn_ = shortened(mouse_turn_ + head_turn(amounts), 3.2);
  mouse_way_ = shortened(mouse_way_ + glm::dvec3(amounts.right, amounts.up, amounts.forward), 2.0);
}

glm::dvec3 SteeredMotion::take_mouse_way(double seconds) {
  constexpr double delay_s = 0.06;
  const glm::dvec3 rate = shortened(mouse_way_ / delay_s, max_speed_);
  mouse_way_ -= rate * std::min(seconds, delay_s);
  return rate;
}

void SteeredMotion::follow_steering(const Steering& s, FlightMode mode, const glm::dquat& view, double eastward,
                                    double seconds) {
  glm::dvec3 head = limits_.head * shortened(head_turn(s), 1.0);
  if (glm::length(head) > 0.0) {
    mouse_turn_ = glm::dvec3(0.0);
  } else {
    head = braked(mouse_turn_, limits_.head, head_part * limits_.acceleration);
  }
  const double speed = usual_part + (1.0 - usual_part) * s.faster;
  const glm::dvec3 way =
      shortened(max_speed_ * speed * shortened({s.right, s.up, s.forward}, 1.0) + take_mouse_way(seconds), max_speed_) /
      max_speed_;
  glm::dvec3 around(0.0);
  glm::dvec3 fly(0.0);
  if (mode == FlightMode::fly) {
    fly = max_speed_ * (view * glm::dvec3(way.x, way.y, -way.z));
  } else if (mode == FlightMode::orbit) {
    around = {limits_.around * way.x * eastward, limits_.around * way.y, -max_speed_ * way.z};
  }

  const double turn_change = limits_.acceleration * seconds;
  follow(head_, head, seconds, head_part * turn_change);
  if (glm::length(mouse_turn_) > 0.0) {
    mouse_turn_ -= seconds * head_;
    const bool there = glm::length(mouse_turn_) < 1e-4 && glm::length(head_) < 1e-3;
    mouse_turn_ = there ? glm::dvec3(0.0) : mouse_turn_;
  }
  // The two angles share one limit of acceleration; the radial motion and the flight share another.
  glm::dvec3 angles(around_.x, around_.y, 0.0);
  follow(angles, {around.x, around.y, 0.0}, seconds, around_part * turn_change);
  glm::dvec3 outward(0.0, 0.0, around_.z);
  const double maximum = max_acceleration_ * seconds;
  const double used = follow(outward, {0.0, 0.0, around.z}, seconds, maximum);
  around_ = {angles.x, angles.y, outward.z};
  follow(fly_, fly, seconds, maximum - used);
}

void SteeredMotion::move_as_ship(const glm::dvec3& fly) {
  head_ = glm::dvec3(0.0);
  around_ = glm::dvec3(0.0);
  fly_ = fly;
}

bool SteeredMotion::coasts() const { return !at_rest(around_) || !at_rest(fly_); }

}  // namespace ergodome
