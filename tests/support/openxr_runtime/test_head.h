#pragma once

#include <array>
#include <cmath>
#include <cstdint>

// Closed forms of the poses and fields of view that the test runtime reports at a display time, so
// that tests can compute them as well. Axes are OpenXR's: +x right, +y up, -z forward.
namespace ergodome::openxr_test {

//! A rigid transformation: a rotation, as a quaternion (x, y, z, w), followed by a shift [m].
struct Pose {
  std::array<double, 4> rotation{0, 0, 0, 1};
  std::array<double, 3> position{};
};

//! Angles of the four edges of an eye's picture [rad]; left and down are negative.
struct FieldOfView {
  double left = 0;
  double right = 0;
  double up = 0;
  double down = 0;
};

//! Returns the product of two quaternions: the rotation by `b`, followed by `a`.
inline std::array<double, 4> product(const std::array<double, 4>& a, const std::array<double, 4>& b) {
  return {a[3] * b[0] + a[0] * b[3] + a[1] * b[2] - a[2] * b[1], a[3] * b[1] - a[0] * b[2] + a[1] * b[3] + a[2] * b[0],
          a[3] * b[2] + a[0] * b[1] - a[1] * b[0] + a[2] * b[3], a[3] * b[3] - a[0] * b[0] - a[1] * b[1] - a[2] * b[2]};
}

inline std::array<double, 4> conjugate(const std::array<double, 4>& q) { return {-q[0], -q[1], -q[2], q[3]}; }

inline std::array<double, 3> rotated(const std::array<double, 4>& q, const std::array<double, 3>& v) {
  const std::array<double, 4> r = product(product(q, {v[0], v[1], v[2], 0}), conjugate(q));
  return {r[0], r[1], r[2]};
}

//! Returns the transformation by `b`, followed by `a`.
inline Pose compose(const Pose& a, const Pose& b) {
  const std::array<double, 3> shift = rotated(a.rotation, b.position);
  return {product(a.rotation, b.rotation),
          {a.position[0] + shift[0], a.position[1] + shift[1], a.position[2] + shift[2]}};
}

inline Pose inverse(const Pose& pose) {
  const std::array<double, 4> back = conjugate(pose.rotation);
  const std::array<double, 3> shift = rotated(back, pose.position);
  return {back, {-shift[0], -shift[1], -shift[2]}};
}

//! Returns a rotation about +y by `yaw`, then the new +x by `pitch`, then the new +z by `roll` [rad].
inline std::array<double, 4> rotation(double yaw, double pitch, double roll) {
  return product(
      product({0, std::sin(yaw / 2), 0, std::cos(yaw / 2)}, {std::sin(pitch / 2), 0, 0, std::cos(pitch / 2)}),
      {0, 0, std::sin(roll / 2), std::cos(roll / 2)});
}

inline double seconds(std::int64_t time_ns) { return 1e-9 * static_cast<double>(time_ns); }

//! Returns the pose of the head in the original STAGE space.
inline Pose head_in_stage(std::int64_t time_ns) {
  const double t = seconds(time_ns);
  return {rotation(0.5 * std::sin(0.7 * t), 0.2 * std::sin(0.9 * t + 1), 0.1 * std::sin(1.1 * t + 2)),
          {0.05 * std::sin(0.8 * t), 1.6 + 0.03 * std::sin(1.3 * t), 0.04 * std::cos(0.6 * t)}};
}

//! Returns the pose of the original LOCAL space in the original STAGE space.
inline Pose local_in_stage() { return {rotation(0.3, 0, 0), {0.1, 1.6, 0.2}}; }

//! Returns the pose of the new space in the old one when the mode `recenter` moves STAGE and LOCAL.
inline Pose recentered_space() { return {rotation(0.5, 0, 0), {0.3, 0, -0.2}}; }

//! Returns the pose of an eye in the head; eye 0 is the left one. The eyes are canted outward by 2°.
inline Pose eye_in_head(int eye, double interpupillary_distance_m) {
  const double side = eye == 0 ? -1 : 1;
  return {rotation(side * -0.034906585, 0, 0), {side * interpupillary_distance_m / 2, 0, 0}};
}

//! Returns the field of view of an eye, which is asymmetric, differs by eye, and changes with time.
inline FieldOfView field_of_view(int eye, std::int64_t time_ns) {
  const double t = seconds(time_ns);
  const double change = 0.02 * std::sin(0.5 * t + eye);
  if (eye == 0) {
    return {-0.93 + change, 0.74 - change, 0.78 + change, -0.86 + change};
  }
  return {-0.72 + change, 0.95 - change, 0.81 - change, -0.83 + change};
}

//! Returns the pose of a controller in the original STAGE space; hand 0 is the left one.
inline Pose hand_in_stage(int hand, bool aim, std::int64_t time_ns) {
  const double t = seconds(time_ns);
  const double side = hand == 0 ? -1 : 1;
  return {rotation(0.3 * side * std::sin(0.9 * t), aim ? 0.1 : -0.6, 0),
          {0.25 * side, 1.1 + 0.05 * std::sin(1.2 * t), -0.35 + 0.05 * std::cos(1.2 * t)}};
}

}  // namespace ergodome::openxr_test
