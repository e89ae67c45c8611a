#include "content/camera/camera_path.h"

#include <algorithm>
#include <cmath>
#include <glm/gtx/quaternion.hpp>
#include <span>
#include <utility>

#include "content/camera/proper_velocity.h"
#include "content/show/animated_show.h"
#include "content/timeline/key_curve.h"
#include "kernels/core/angles.h"

namespace ergodome {

namespace {

using CameraKeys = std::span<const CameraKey>;

//! Returns when the camera leaves a key [s].
double leave_s(const CameraKey& key) { return key.time_s + key.hold_s; }

//! The path segment from a key to the next one.
struct Way {
  std::size_t from;
  double span_s;
  SpanEnds ends;
};

double span_s(const CameraKeys& keys, std::size_t i) { return keys[i + 1].time_s - leave_s(keys[i]); }

//! Returns the first and second derivatives by time of a quantity at both ends of a segment.
//! `rise(i)` is the quantity's increase from key i to the next one.
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

//! Returns the coordinate that `value(key)` selects, at the fraction t in [0, 1] of a segment.
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

//! Returns the axis of a rotation times half its angle.
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

//! Returns the logarithm of the shortest rotation from the orientation at key i to that at the next
//! key. It is the same vector in the frames of both keys.
glm::dvec3 turn_between(const CameraKeys& keys, std::size_t i) {
  const glm::dquat from = key_orientation(keys[i]);
  return logarithm(glm::inverse(from) * nearer(key_orientation(keys[i + 1]), from));
}

//! Interpolates the orientation so that it is C² within a segment: the cumulative form of Kim, Kim
//! & Shin (SIGGRAPH 1995), with the Bernstein basis of degree five.
//!
//! q(t) = q0 Π exp(ω_k B_k(t)), where B_k is the sum of the basis functions from k on, and ω_k is
//! an axis times half an angle, as in logarithm(). In the camera's frame, half its angular velocity
//! at t = 0 is 5 ω1 and the derivative of that 20 (ω2 - ω1). At t = 1 these are 5 ω5 and
//! 20 (ω5 - R ω4), where R is the inverse rotation by ω5. At a key, each component of the angular
//! velocity is limited in the same way as the rate of a coordinate. The two segments at a key use
//! the camera's frame there, so that their angular velocities match.
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

//! Returns the keys up to a time, inclusive.
CameraKeys keys_until(CameraKeys keys, double time_s) {
  return {keys.begin(), std::ranges::upper_bound(keys, time_s, {}, &CameraKey::time_s)};
}

//! Position of a time on the path: a segment and the completed fraction `t` of it, or the key at
//! which the camera rests: a held key, the first key before its time, or the last key after its
//! time.
struct OnTheWay {
  std::optional<std::size_t> held;
  Way way{};
  double t = 0.0;
};

OnTheWay on_the_way(CameraKeys keys, double time_s) {
  const auto after = std::ranges::upper_bound(keys, time_s, {}, &CameraKey::time_s);
  if (after == keys.begin()) {
    return {0};
  }
  const auto i = static_cast<std::size_t>(after - keys.begin()) - 1;
  if (after == keys.end() || time_s <= leave_s(keys[i])) {
    return {i};
  }
  const Way way = {i, span_s(keys, i), span_ends(keys.size(), i, [&](std::size_t k) {
                     return CurveKey{keys[k].time_s, leave_s(keys[k]), keys[k].ease};
                   })};
  return {std::nullopt, way, (time_s - leave_s(keys[i])) / way.span_s};
}

glm::dquat orientation_at(CameraKeys keys, double time_s) {
  const OnTheWay now = on_the_way(keys, time_s);
  return now.held ? key_orientation(keys[*now.held]) : orientation_between(keys, now.way, now.t);
}

//! Returns the camera's position and, if keys have one, its velocity, without the orientation.
CameraPose key_pose_at(CameraKeys keys, double time_s) {
  const OnTheWay now = on_the_way(keys, time_s);
  if (now.held) {
    const CameraKey& key = keys[*now.held];
    return {key.r, key.theta, key.phi, {}, key.velocity};
  }
  const auto along = [&](auto value) { return interpolated(keys, now.way, now.t, value); };
  CameraPose pose = {std::exp(along([](const CameraKey& key) { return std::log(key.r); })),
                     along([](const CameraKey& key) { return key.theta; }),
                     along([](const CameraKey& key) { return key.phi; }),
                     {}};
  if (keys.front().velocity) {
    pose.velocity = velocity_of_proper({along([](const CameraKey& key) { return proper_velocity(*key.velocity).x; }),
                                        along([](const CameraKey& key) { return proper_velocity(*key.velocity).y; }),
                                        along([](const CameraKey& key) { return proper_velocity(*key.velocity).z; })});
  }
  return pose;
}

//! Returns a velocity between that of the keys or of the show's observer (part 0) and that of a
//! fall, `falls` (part 1).
Vector3<double> between_observer_and_fall(const Show& show, double time_s, const CameraPose& pose,
                                          const Vector3<double>& falls, double part) {
  const Vector3<double> own = pose.velocity.value_or(
      observer_velocity(show.camera.motion, spacetime_at(show, time_s), pose.r, pose.theta, show.camera.velocity));
  return own + part * (falls - own);
}

//! Returns the camera's pose at a time before its fall, without an orientation.
CameraPose pose_before_fall(const Show& show, double time_s) {
  const FreeFall& orbit = *show.camera.orbit;
  CameraPose pose = key_pose_at(keys_until(show.camera.keys, orbit.begin_s()), time_s);
  if (time_s > orbit.begin_s() - orbit.ease_s()) {
    const double part = eased(1.0 + (time_s - orbit.begin_s()) / orbit.ease_s());
    pose.velocity = between_observer_and_fall(show, time_s, pose, orbit.start().velocity, part);
  }
  return pose;
}

//! Returns the fraction of the roll around e_r that a fall has caused and that still remains after
//! it. The roll is removed on the way to the next key.
double roll_left(CameraKeys path, double time_s) {
  if (path.size() < 2 || !(time_s > leave_s(path[0]))) {
    return 1.0;
  }
  return 1.0 - eased(std::min((time_s - leave_s(path[0])) / span_s(path, 0), 1.0));
}

//! Returns the camera's pose at a time after its fall. `orientation` is relative to the frame that
//! was transported along the fall.
CameraPose pose_after_fall(const Show& show, double time_s, const glm::dquat& orientation) {
  const FreeFall& orbit = *show.camera.orbit;
  const FallPosition end = orbit.at(time_s);
  CameraPose pose = key_pose_at(show.camera.after_fall, time_s);
  const glm::dvec3 roll = logarithm(nearer(end.frame, glm::dquat(1.0, 0.0, 0.0, 0.0)));
  pose.orientation = glm::normalize(exponential(roll_left(show.camera.after_fall, time_s) * roll) * orientation);
  const double since_s = time_s - *orbit.until_s();
  if (since_s < orbit.ease_s()) {
    pose.velocity = between_observer_and_fall(show, time_s, pose, end.velocity, eased(1.0 - since_s / orbit.ease_s()));
  }
  return pose;
}

CameraPose pose_on_path(const Show& show, double time_s) {
  const FreeFall* const orbit = show.camera.orbit.get();
  const glm::dquat orientation = orientation_at(show.camera.keys, time_s);
  if (orbit != nullptr && orbit->until_s() && time_s > *orbit->until_s()) {
    return pose_after_fall(show, time_s, orientation);
  }
  if (orbit != nullptr && time_s >= orbit->begin_s()) {
    const FallPosition position = orbit->at(time_s);
    const glm::dquat turned = glm::normalize(position.frame * orientation);
    return {position.r, position.theta, position.phi, turned, position.velocity, orbit->leads_within()};
  }
  CameraPose pose = orbit != nullptr ? pose_before_fall(show, time_s) : key_pose_at(show.camera.keys, time_s);
  pose.orientation = orientation;
  return pose;
}

}  // namespace

CameraPose camera_pose(const Show& show, double time_s) {
  CameraPose pose = pose_on_path(show, time_s);
  if (leads_within(show)) {
    pose.clock_lead = outer_lag(spacetime_of(show), pose.r);
  }
  return pose;
}

std::shared_ptr<const FreeFall> follow_fall(const Show& show) {
  if (!show.camera.fall) {
    return nullptr;
  }
  // The fall is computed for this time after the show's end, because camera shutters close after
  // the last frame.
  constexpr double beyond_s = 1.0;
  const FallSettings& fall = *show.camera.fall;
  const CameraKey& key = keys_until(show.camera.keys, fall.time_s).back();
  const FallStart start = {key.r, key.theta, key.phi,
                           observer_velocity(fall.motion, spacetime_of(show), key.r, key.theta, fall.velocity)};
  return std::make_shared<const FreeFall>(spacetime_of(show), start, fall, find_animation(show, "camera.fall.clock"),
                                          show.duration_s + beyond_s);
}

std::vector<CameraKey> keys_after_fall(const Show& show) {
  const FreeFall* const orbit = show.camera.orbit.get();
  if (orbit == nullptr || !orbit->until_s()) {
    return {};
  }
  const double until_s = *orbit->until_s();
  const CameraKeys during = keys_until(show.camera.keys, until_s);
  const FallPosition end = orbit->at(until_s);
  CameraKey first;
  first.time_s = until_s;
  first.r = end.r;
  first.theta = end.theta;
  first.phi = end.phi;
  if (during.back().time_s == until_s) {
    first.hold_s = during.back().hold_s;
    first.ease = during.back().ease;
  }
  std::vector<CameraKey> path = {first};
  path.insert(path.end(), show.camera.keys.begin() + std::ssize(during), show.camera.keys.end());
  for (std::size_t i = path.size(); i-- > 1;) {
    path[i].phi += 2.0 * pi * std::round((first.phi - path[1].phi) / (2.0 * pi));
  }
  return path;
}

bool leads_within(const Show& show) { return show.camera.orbit != nullptr && show.camera.orbit->leads_within(); }

bool camera_moves(const Show& show) { return show.camera.keys.size() > 1 || show.camera.orbit != nullptr; }

std::vector<double> path_ends_s(const Show& show) {
  std::vector<double> ends = {0.0, show.duration_s};
  const auto add = [&](double time_s) { ends.push_back(std::clamp(time_s, 0.0, show.duration_s)); };
  for (const CameraKey& key : show.camera.keys) {
    add(key.time_s);
    add(leave_s(key));
  }
  if (show.camera.orbit) {
    const FreeFall& orbit = *show.camera.orbit;
    for (const FallTurn& turn : orbit.turns()) {
      add(turn.time_s);
    }
    add(orbit.begin_s() - orbit.ease_s());
    add(orbit.stop_s().value_or(show.duration_s));
    if (orbit.until_s()) {
      add(*orbit.until_s());
      add(*orbit.until_s() + orbit.ease_s());
    }
  }
  std::ranges::sort(ends);
  ends.erase(std::unique(ends.begin(), ends.end()), ends.end());
  return ends;
}

}  // namespace ergodome
