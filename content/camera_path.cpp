#include "content/camera_path.h"

#include <algorithm>
#include <cmath>
#include <glm/gtx/quaternion.hpp>

namespace ergodome {

namespace {

using Keys = std::vector<CameraKey>;

//! Slope at a key for a monotone C¹ cubic (Fritsch & Butland 1984: the weighted harmonic mean of the chords, 0 at an extremum).
template <class Value>
double slope_at(const Keys& keys, std::size_t i, const Value& value) {
  if (i == 0 || i + 1 == keys.size()) {
    return 0.0;  // starts and stops softly
  }
  const double before_s = keys[i].time_s - keys[i - 1].time_s;
  const double after_s = keys[i + 1].time_s - keys[i].time_s;
  const double before = (value(keys[i]) - value(keys[i - 1])) / before_s;
  const double after = (value(keys[i + 1]) - value(keys[i])) / after_s;
  if (before * after <= 0.0) {
    return 0.0;
  }
  const double w1 = 2.0 * after_s + before_s;
  const double w2 = after_s + 2.0 * before_s;
  return (w1 + w2) / (w1 / before + w2 / after);
}

//! Cubic Hermite on one span; t in [0, 1].
template <class Value>
double interpolated(const Keys& keys, std::size_t i, double t, const Value& value) {
  const double span_s = keys[i + 1].time_s - keys[i].time_s;
  const double p0 = value(keys[i]);
  const double p1 = value(keys[i + 1]);
  const double m0 = span_s * slope_at(keys, i, value);
  const double m1 = span_s * slope_at(keys, i + 1, value);
  const double t2 = t * t;
  const double t3 = t2 * t;
  return (2.0 * t3 - 3.0 * t2 + 1.0) * p0 + (t3 - 2.0 * t2 + t) * m0 + (3.0 * t2 - 2.0 * t3) * p1 + (t3 - t2) * m1;
}

glm::dquat nearer(const glm::dquat& q, const glm::dquat& to) { return glm::dot(q, to) < 0.0 ? -q : q; }

//! Logarithm of the turn from one key's orientation to the next, the short way: an axis times half an angle.
glm::dvec3 turn_between(const Keys& keys, std::size_t i) {
  const glm::dquat from = key_orientation(keys[i]);
  const glm::dquat turn = glm::inverse(from) * nearer(key_orientation(keys[i + 1]), from);
  const glm::dvec3 v(turn.x, turn.y, turn.z);
  const double sine = glm::length(v);
  return sine > 0.0 ? v * (std::atan2(sine, turn.w) / sine) : glm::dvec3(0.0);
}

glm::dquat exponential(const glm::dvec3& v) {
  const double half_angle = glm::length(v);
  const double factor = half_angle > 1e-12 ? std::sin(half_angle) / half_angle : 1.0;
  return {std::cos(half_angle), v.x * factor, v.y * factor, v.z * factor};
}

//! Turning rate at a key [half radians per second]: the mean of the turns on both sides, each slowed by the other's span.
glm::dvec3 turn_rate(const Keys& keys, std::size_t i) {
  if (i == 0 || i + 1 == keys.size()) {
    return glm::dvec3(0.0);
  }
  const double before_s = keys[i].time_s - keys[i - 1].time_s;
  const double after_s = keys[i + 1].time_s - keys[i].time_s;
  return (turn_between(keys, i - 1) / before_s * after_s + turn_between(keys, i) / after_s * before_s) /
         (before_s + after_s);
}

//! C¹ between keys: cumulative form of Kim, Kim & Shin (SIGGRAPH 1995), with the Bernstein basis of a cubic Bézier curve.
glm::dquat orientation_between(const Keys& keys, std::size_t i, double t) {
  const double third_s = (keys[i + 1].time_s - keys[i].time_s) / 3.0;
  const glm::dquat q0 = key_orientation(keys[i]);
  const glm::dvec3 first = turn_rate(keys, i) * third_s;
  const glm::dvec3 last = turn_rate(keys, i + 1) * third_s;
  const glm::dquat whole = exponential(turn_between(keys, i));
  const glm::dquat rest = glm::inverse(exponential(first)) * whole * glm::inverse(exponential(last));
  const glm::dvec3 v(rest.x, rest.y, rest.z);
  const double sine = glm::length(v);
  const glm::dvec3 middle = sine > 0.0 ? v * (std::atan2(sine, rest.w) / sine) : glm::dvec3(0.0);
  const double s = 1.0 - t;
  const double b1 = 1.0 - s * s * s;
  const double b2 = t * t * (3.0 - 2.0 * t);
  const double b3 = t * t * t;
  return glm::normalize(q0 * exponential(first * b1) * exponential(middle * b2) * exponential(last * b3));
}

}  // namespace

glm::dquat key_orientation(const CameraKey& key) {
  glm::dvec3 forward(-1.0, 0.0, 0.0);
  if (key.look.kind == LookTarget::Kind::away) {
    forward = -forward;
  } else if (key.look.kind == LookTarget::Kind::direction) {
    forward = glm::normalize(glm::dvec3(key.look.direction.x, key.look.direction.y, key.look.direction.z));
  }
  const glm::dvec3 north(0.0, -1.0, 0.0);
  const glm::dvec3 across = glm::cross(forward, north);
  // Looking along the meridian's pole there is no "up"; the outward radial direction serves.
  const glm::dvec3 right = glm::length(across) > 1e-9 ? glm::normalize(across) : glm::dvec3(0.0, 0.0, 1.0);
  const glm::dvec3 up = glm::cross(right, forward);
  const glm::dquat look = glm::quat_cast(glm::dmat3(right, up, -forward));
  const glm::dquat yaw = glm::angleAxis(-key.yaw, glm::dvec3(0.0, 1.0, 0.0));
  const glm::dquat pitch = glm::angleAxis(key.pitch, glm::dvec3(1.0, 0.0, 0.0));
  const glm::dquat roll = glm::angleAxis(-key.roll, glm::dvec3(0.0, 0.0, 1.0));
  return glm::normalize(look * yaw * pitch * roll);
}

CameraPose camera_pose(const Show& show, double time_s) {
  const Keys& keys = show.camera.keys;
  const auto hold = [](const CameraKey& key) { return CameraPose{key.r, key.theta, key.phi, key_orientation(key)}; };
  const auto after =
      std::upper_bound(keys.begin(), keys.end(), time_s, [](double t, const CameraKey& key) { return t < key.time_s; });
  if (after == keys.begin()) {
    return hold(keys.front());
  }
  if (after == keys.end()) {
    return hold(keys.back());
  }
  const auto i = static_cast<std::size_t>(after - keys.begin()) - 1;
  const double t = (time_s - keys[i].time_s) / (keys[i + 1].time_s - keys[i].time_s);
  return {std::exp(interpolated(keys, i, t, [](const CameraKey& key) { return std::log(key.r); })),
          interpolated(keys, i, t, [](const CameraKey& key) { return key.theta; }),
          interpolated(keys, i, t, [](const CameraKey& key) { return key.phi; }), orientation_between(keys, i, t)};
}

}  // namespace ergodome
