#include "content/camera_path.h"

#include <algorithm>
#include <cmath>
#include <glm/gtx/quaternion.hpp>
#include <utility>

#include "content/key_curve.h"

namespace ergodome {

namespace {

using CameraKeys = std::vector<CameraKey>;

//! When the camera leaves a key.
double leave_s(const CameraKey& key) { return key.time_s + key.hold_s; }

//! The way from a key to the next one.
struct Way {
  std::size_t from;
  double span_s;
  SpanEnds ends;
};

double span_s(const CameraKeys& keys, std::size_t i) { return keys[i + 1].time_s - leave_s(keys[i]); }

//! Derivatives of some measure of the path at both ends of a way. `rise(i)` is what it adds from key i to the next one.
template <class Rise>
std::pair<KeyMotion, KeyMotion> motions(const CameraKeys& keys, const Way& way, const Rise& rise) {
  const auto chord = [&](std::size_t i) {
    const double span = span_s(keys, i);
    return Chord{rise(i) / span, span};
  };
  const Chord own = chord(way.from);
  return {motion_at_begin(way.ends.begin, way.from > 0 ? chord(way.from - 1) : own, own),
          motion_at_end(way.ends.end, own, way.from + 2 < keys.size() ? chord(way.from + 1) : own)};
}

//! A coordinate at t in [0, 1] of a way.
template <class Value>
double interpolated(const CameraKeys& keys, const Way& way, double t, const Value& value) {
  const double from = value(keys[way.from]);
  const double to = value(keys[way.from + 1]);
  if (keys[way.from].ease == Ease::linear) {
    return from + (to - from) * t;
  }
  const auto [begin, end] = motions(keys, way, [&](std::size_t i) { return value(keys[i + 1]) - value(keys[i]); });
  return quintic(from, to, way.span_s, begin, end, t);
}

glm::dquat nearer(const glm::dquat& q, const glm::dquat& to) { return glm::dot(q, to) < 0.0 ? -q : q; }

//! Axis times half the angle of a turn.
glm::dvec3 logarithm(const glm::dquat& turn) {
  const glm::dvec3 v(turn.x, turn.y, turn.z);
  const double sine = glm::length(v);
  return sine > 0.0 ? v * (std::atan2(sine, turn.w) / sine) : glm::dvec3(0.0);
}

glm::dquat exponential(const glm::dvec3& v) {
  const double half_angle = glm::length(v);
  const double factor = half_angle > 1e-12 ? std::sin(half_angle) / half_angle : 1.0;
  return {std::cos(half_angle), v.x * factor, v.y * factor, v.z * factor};
}

//! Logarithm of the turn from one key's orientation to the next, the short way. It is the same vector in the frames of both.
glm::dvec3 turn_between(const CameraKeys& keys, std::size_t i) {
  const glm::dquat from = key_orientation(keys[i]);
  return logarithm(glm::inverse(from) * nearer(key_orientation(keys[i + 1]), from));
}

//! C² between keys: the cumulative form of Kim, Kim & Shin (SIGGRAPH 1995), with the Bernstein basis of degree five.
//!
//! q(t) = q0 Π exp(ω_k B_k(t)), B_k the sum of the basis from k on. In the camera's own frame its turning rate at t = 0 is 5 ω1 and
//! changes by 20 (ω2 - ω1); at t = 1 they are 5 ω5 and 20 (ω5 - R ω4), where R turns back by ω5. Rates of a key are limited part by part
//! as those of a coordinate are, and the ways on both sides have them in the key's own frame: that is one frame.
glm::dquat orientation_between(const CameraKeys& keys, const Way& way, double t) {
  const glm::dquat q0 = key_orientation(keys[way.from]);
  const glm::dvec3 whole = turn_between(keys, way.from);
  if (keys[way.from].ease == Ease::linear) {
    return glm::normalize(q0 * exponential(whole * t));
  }
  const glm::dvec3 before = way.from > 0 ? turn_between(keys, way.from - 1) : whole;
  const glm::dvec3 after = way.from + 2 < keys.size() ? turn_between(keys, way.from + 1) : whole;
  glm::dvec3 turn[5];
  for (int part = 0; part < 3; ++part) {
    const auto [begin, end] = motions(keys, way, [&](std::size_t i) {
      return i < way.from ? before[part] : i > way.from ? after[part] : whole[part];
    });
    turn[0][part] = way.span_s * begin.rate / 5.0;
    turn[1][part] = turn[0][part] + way.span_s * way.span_s * begin.change / 20.0;
    turn[4][part] = way.span_s * end.rate / 5.0;
    turn[3][part] = turn[4][part] - way.span_s * way.span_s * end.change / 20.0;
  }
  turn[3] = exponential(turn[4]) * turn[3];
  turn[2] = logarithm(glm::inverse(exponential(turn[0]) * exponential(turn[1])) * exponential(whole) *
                      glm::inverse(exponential(turn[3]) * exponential(turn[4])));
  const double s = 1.0 - t;
  const double basis[6] = {s * s * s * s * s,        5.0 * s * s * s * s * t, 10.0 * s * s * s * t * t,
                           10.0 * s * s * t * t * t, 5.0 * s * t * t * t * t, t * t * t * t * t};
  glm::dquat turned(1.0, 0.0, 0.0, 0.0);
  double sum = 0.0;
  for (int k = 5; k > 0; --k) {
    sum += basis[k];
    turned = exponential(turn[k - 1] * sum) * turned;
  }
  return glm::normalize(q0 * turned);
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
  const CameraKeys& keys = show.camera.keys;
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
  if (time_s <= leave_s(keys[i])) {
    return hold(keys[i]);
  }
  const Way way = {i, span_s(keys, i), span_ends(keys.size(), i, [&](std::size_t k) {
                     return CurveKey{keys[k].time_s, leave_s(keys[k]), keys[k].ease};
                   })};
  const double t = (time_s - leave_s(keys[i])) / way.span_s;
  return {std::exp(interpolated(keys, way, t, [](const CameraKey& key) { return std::log(key.r); })),
          interpolated(keys, way, t, [](const CameraKey& key) { return key.theta; }),
          interpolated(keys, way, t, [](const CameraKey& key) { return key.phi; }), orientation_between(keys, way, t)};
}

}  // namespace ergodome
