#pragma once

#include "kernels/spacetime/geodesic/radial_potential.h"
#include "kernels/spacetime/kerr/camera_station.h"

// Polar coordinates about the shadow on a camera's sky.
namespace ergodome {

//! Polar coordinates on the camera's sky about a point inside the shadow.
//!
//! Direction = cosα `centre` + sinα (cosγ `first` + sinγ `second`) with the polar angle α and the
//! position angle γ.
struct ShadowChart {
  Vector3<double> centre;
  Vector3<double> first;
  Vector3<double> second;
};

inline namespace ERGO_TARGET {

ERGO_HD Vector3<double> normalized(const Vector3<double>& v) { return (1.0 / ::sqrt(dot(v, v))) * v; }

//! Returns the direction at (α, γ), for any real type.
template <class T>
ERGO_HD Vector3<T> chart_direction(const ShadowChart& chart, const T& cosine_alpha, const T& sine_alpha, double gamma) {
  using S = ScalarOf<T>;
  const Vector3<double> across = ::cos(gamma) * chart.first + ::sin(gamma) * chart.second;
  return {cosine_alpha * S(chart.centre.x) + sine_alpha * S(across.x),
          cosine_alpha * S(chart.centre.y) + sine_alpha * S(across.y),
          cosine_alpha * S(chart.centre.z) + sine_alpha * S(across.z)};
}

//! Returns the polar angle α of a unit direction [rad], accurate near both poles.
ERGO_HD double chart_polar_angle(const ShadowChart& chart, const Vector3<double>& n) {
  const double x = dot(n, chart.first);
  const double y = dot(n, chart.second);
  return ::atan2(::sqrt(x * x + y * y), dot(n, chart.centre));
}

//! Returns the position angle γ of a unit direction [rad, -π to π].
ERGO_HD double chart_position_angle(const ShadowChart& chart, const Vector3<double>& n) {
  return ::atan2(dot(n, chart.second), dot(n, chart.first));
}

//! Returns whether light that the observer sees in direction n comes from the sky.
ERGO_HD bool direction_is_bright(const CameraStation& camera, const Vector3<double>& n) {
  return comes_from_sky(camera.spin, camera.horizon_r, start_ray(camera, n));
}

namespace detail {
//! Returns the direction of a principal null ray in the observer's frame; `side` is +1 for the
//! outgoing ray and -1 for the ingoing one. The two conditions e_θ · m' = 0 and L = a sin²θ E are
//! planes in the direction n, and their line meets the unit sphere at these two rays.
ERGO_HD Vector3<double> principal_direction(const CameraStation& camera, double side) {
  const Vector3<double> p = camera.polar_rate.along;
  const double p0 = camera.polar_rate.constant;
  const double a_sine = camera.spin * camera.sine_theta;
  const Vector3<double> q = camera.azimuthal_rate.along + a_sine * camera.energy.along;
  const double q0 = camera.azimuthal_rate.constant + a_sine * camera.energy.constant;
  const Vector3<double> line = cross(p, q);
  const double l2 = dot(line, line);
  const Vector3<double> foot = (1.0 / l2) * (p0 * cross(line, q) - q0 * cross(line, p));
  const Vector3<double> along = normalized(line);
  const double reach = ::sqrt(::fmax(0.0, 1.0 - dot(foot, foot)));
  const double outwards = dot(camera.outward_rate.along, along) >= 0.0 ? 1.0 : -1.0;
  return normalized(foot + (side * outwards * reach) * along);
}
}  // namespace detail

}  // namespace ERGO_TARGET
}  // namespace ergodome
