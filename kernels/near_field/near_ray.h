#pragma once

#include "kernels/metric/camera_station.h"

namespace ergodome {

//! A null geodesic at the camera, in Mino time that runs backwards, for a photon whose energy the *observer* sees as 1.
//!
//! RayStart has the energy at infinity as its unit; matter near a spinning hole also sends light whose energy there is 0 or less, to cameras
//! inside the ergosphere.
template <class T>
struct NearRay {
  T energy;                  //!< E at infinity, over the energy seen
  T axial_angular_momentum;  //!< L_z [M]
  T polar_constant;          //!< C = Q + L² = |m'|² - a² E² m_z² [M²]
  T carter;                  //!< Q [M²]
  T shear_constant;          //!< K = Q + (L - a E)² >= 0 [M²]
  T u;                       //!< 1 / r [1/M]
  T u_rate;                  //!< du/dλ; u_rate² = E² + (a² E² - C) u² + 2 K u³ - a² Q u⁴
  Vector3<T> m;              //!< polar position without frame dragging, φ = 0 at the camera
  Vector3<T> m_rate;         //!< dm/dλ [M]
};

inline namespace ERGO_TARGET {

//! The ray that the observer sees in direction `n` (unit vector in the observer's frame: e_r, e_θ, e_φ).
//!
//! A camera within rounding of the equator is on it: its rays do not cross the plane where they start.
template <class T>
ERGO_HD NearRay<T> start_near_ray(const CameraStationOf<ScalarOf<T>>& camera, const Vector3<T>& n) {
  using S = ScalarOf<T>;
  NearRay<T> ray;
  ray.energy = detail::evaluate(camera.energy, n);
  ray.axial_angular_momentum = detail::evaluate(camera.axial_momentum, n);
  ray.u = T(camera.u);
  ray.u_rate = -detail::evaluate(camera.outward_rate, n);
  const T polar = detail::evaluate(camera.polar_rate, n);
  const T azimuthal = detail::evaluate(camera.azimuthal_rate, n);
  const bool on_equator = absolute(camera.cosine_theta) < S(4) * std::numeric_limits<S>::epsilon();
  const S cosine = on_equator ? S(0) : camera.cosine_theta;
  ray.m = {T(camera.sine_theta), T(S(0)), T(cosine)};
  ray.m_rate = {cosine * polar, azimuthal, -(camera.sine_theta * polar)};
  const S a2 = camera.spin * camera.spin;
  const T a2e2 = a2 * (ray.energy * ray.energy);
  const T l = ray.axial_angular_momentum;
  ray.polar_constant = polar * polar + azimuthal * azimuthal - (cosine * cosine) * a2e2;
  // Q = p_θ² + cos²θ (L² / sin²θ - a² E²), and L = sinθ times the azimuthal rate: nothing cancels near the axis.
  ray.carter = polar * polar + (cosine * cosine) * (azimuthal * azimuthal - a2e2);
  const T skew = l - camera.spin * ray.energy;
  ray.shear_constant = ray.carter + skew * skew;
  return ray;
}

//! A ray without its derivatives.
template <class T>
ERGO_HD NearRay<RealOf<T>> plain_ray(const NearRay<T>& ray) {
  return {value_of(ray.energy),
          value_of(ray.axial_angular_momentum),
          value_of(ray.polar_constant),
          value_of(ray.carter),
          value_of(ray.shear_constant),
          value_of(ray.u),
          value_of(ray.u_rate),
          {value_of(ray.m.x), value_of(ray.m.y), value_of(ray.m.z)},
          {value_of(ray.m_rate.x), value_of(ray.m_rate.y), value_of(ray.m_rate.z)}};
}

}  // namespace ERGO_TARGET
}  // namespace ergodome
