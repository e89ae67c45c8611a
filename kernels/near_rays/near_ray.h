#pragma once

#include "kernels/spacetime/kerr/camera_station.h"
#include "kernels/spacetime/trace/omni_camera.h"

namespace ergodome {

//! A null geodesic at the camera, in Mino time that runs backwards, for a photon whose energy the
//! *observer* sees as 1.
//!
//! RayStart uses the energy at infinity as its unit. But matter near a spinning hole can also send
//! light whose energy at infinity is 0 or less, to cameras inside the ergosphere.
template <class T>
struct NearRay {
  //! E: the photon's energy at infinity over the energy that the observer sees.
  T energy;
  T axial_angular_momentum;  //!< L = L_z of the photon [M]
  T polar_constant;          //!< C = Q + L² = |m'|² - a² E² m_z² [M²]
  T carter;                  //!< Q, Carter's constant [M²]
  T shear_constant;          //!< K = Q + (L - a E)² >= 0 [M²]
  T u;                       //!< u = 1 / r [1/M]
  T u_rate;                  //!< du/dλ; u_rate² = E² + (a² E² - C) u² + 2 K u³ - a² Q u⁴
  //! Polar position, a unit vector as in RayStart: without frame dragging, φ = 0 at the camera (for
  //! omnidirectional stereo, at the head).
  Vector3<T> m;
  Vector3<T> m_rate;  //!< dm/dλ [M]; λ: Mino time
  //! The camera is inside the horizon or near it, as in RayStart: azimuth and time of light that
  //! moves only inwards are in ingoing Kerr coordinates (near_azimuth.h).
  bool ingoing = false;
  //! The camera's azimuth in ingoing Kerr coordinates [rad]; 0 inside the horizon, and for
  //! omnidirectional eyes, whose `m` already contains it.
  ScalarOf<T> turn = ScalarOf<T>(0);
  ScalarOf<T> lag = ScalarOf<T>(0);  //!< outer_lag() of the camera if `ingoing`, otherwise 0 [M]
};

inline namespace ERGO_TARGET {

//! Returns the ray that the observer sees in direction `n` (unit vector in the observer's frame:
//! e_r, e_θ, e_φ).
//!
//! A camera within rounding of the equator is treated as on it: its rays do not cross the
//! equatorial plane where they start.
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
  // Q = p_θ² + cos²θ (L² / sin²θ - a² E²), and L = sinθ times the azimuthal rate, so nothing
  // cancels near the spin axis.
  ray.carter = polar * polar + (cosine * cosine) * (azimuthal * azimuthal - a2e2);
  const T skew = l - camera.spin * ray.energy;
  ray.shear_constant = ray.carter + skew * skew;
  ray.ingoing = camera.ingoing;
  ray.turn = camera.turn;
  ray.lag = camera.lag;
  return ray;
}

//! Returns the ray that an eye of omnidirectional stereo sees in a direction of the view. Its m is
//! in axes that are turned to the head's azimuth.
template <class T>
ERGO_HD NearRay<T> start_near_ray(const OmniCameraOf<ScalarOf<T>>& camera, const Vector3<T>& view) {
  using S = ScalarOf<T>;
  const OmniSight<T> sight = omni_sight(camera, view);
  NearRay<T> ray;
  ray.energy = sight.energy;
  ray.axial_angular_momentum = sight.axial_momentum;
  ray.u = sight.u;
  ray.u_rate = -sight.outward_rate;
  ray.m = sight.m;
  ray.m_rate = sight.m_rate;
  const auto on_equator = absolute(value_of(ray.m.z)) < RealOf<T>(S(4) * std::numeric_limits<S>::epsilon());
  ray.m.z = select(on_equator, T(S(0)), ray.m.z);
  const Vector3<T> moment = cross(ray.m, ray.m_rate);
  const S a = camera.spin;
  const T drag = (a * a) * (ray.energy * ray.energy) * (ray.m.z * ray.m.z);
  ray.polar_constant = dot(ray.m_rate, ray.m_rate) - drag;
  // |m'|² is the square of m x m', whose component along the spin axis is L. Without that component
  // nothing cancels.
  ray.carter = moment.x * moment.x + moment.y * moment.y - drag;
  const T skew = ray.axial_angular_momentum - a * ray.energy;
  ray.shear_constant = ray.carter + skew * skew;
  // Head and eyes are simultaneous in the time of infalling observers. (For the few rays that go
  // inwards, the difference between the Boyer-Lindquist times of eye and head is neglected.)
  ray.ingoing = camera.ingoing;
  ray.lag = camera.lag;
  return ray;
}

//! Returns the ray of a picture: all directions are seen by one camera or, if `omni` has
//! coefficients, each by its own.
template <class T>
ERGO_HD NearRay<T> start_near_ray(const CameraStationOf<ScalarOf<T>>& camera, const OmniCameraOf<ScalarOf<T>>& omni,
                                  const Vector3<T>& n) {
  return omni.coefficients != nullptr ? start_near_ray(omni, n) : start_near_ray(camera, n);
}

//! Returns the lanes with light that only comes in to the camera, whose azimuth and time are in
//! ingoing Kerr coordinates.
template <class T>
ERGO_HD MaskOf<RealOf<T>> counts_ingoing(const NearRay<T>& ray) {
  using Real = RealOf<T>;
  const Real zero(ScalarOf<T>(0));
  const auto in = value_of(ray.u_rate) < zero;
  return ray.ingoing ? in : in & !in;
}

//! Returns the lanes that begin within the horizon.
template <class T>
ERGO_HD MaskOf<RealOf<T>> begins_within(ScalarOf<T> spin, const NearRay<T>& ray) {
  using S = ScalarOf<T>;
  const S horizon_r = kerr_horizon_radius(spin);
  return value_of(ray.u) * horizon_r > RealOf<T>(S(1));
}

//! Returns the lanes whose light has been outside the horizon. These are all lanes that begin
//! outside it, and of those that begin within it the ones whose light came in through it, with E
//! (r_+² + a²) - a L > 0. All other light is from another universe, and dark.
template <class T>
ERGO_HD MaskOf<RealOf<T>> has_been_outside(ScalarOf<T> spin, const NearRay<T>& ray) {
  using S = ScalarOf<T>;
  using Real = RealOf<T>;
  const S horizon_r = kerr_horizon_radius(spin);
  const Real moment = (S(2) * horizon_r) * value_of(ray.energy) - spin * value_of(ray.axial_angular_momentum);
  const Real zero(S(0));
  return (!begins_within(spin, ray)) | ((moment > zero) & (value_of(ray.u_rate) < zero));
}

//! Returns a ray without its derivatives.
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
          {value_of(ray.m_rate.x), value_of(ray.m_rate.y), value_of(ray.m_rate.z)},
          ray.ingoing,
          ray.turn,
          ray.lag};
}

}  // namespace ERGO_TARGET
}  // namespace ergodome
