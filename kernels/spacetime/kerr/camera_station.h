#pragma once

#include "kernels/core/angles.h"
#include "kernels/core/arithmetic.h"
#include "kernels/spacetime/kerr/observer.h"
#include "kernels/spacetime/kerr/ray.h"

// Cameras in Kerr spacetime: what all rays of one camera share, and the rays that it sees.
namespace ergodome {

//! An affine function of the viewing direction: value = constant + along · n.
template <class S>
struct DirectionForm {
  S constant;
  Vector3<S> along;
};

//! Position and motion of a camera, in the form that its rays need. It is computed once, in double,
//! and shared by all rays.
//!
//! The conserved quantities of a light ray, and its first derivatives, are affine in the direction
//! in which the observer sees it. Their coefficients contain the observer's velocity (aberration,
//! one Lorentz transform) and all terms that are large or cancel near the horizon. So each ray can
//! be set up in float.
template <class S>
struct CameraStationOf {
  S spin;       //!< a [M]
  S horizon_r;  //!< radius of the outer horizon [M]
  S u;          //!< 1 / r [1/M]
  S sine_phi;   //!< sine and cosine of the camera's azimuth, which only rotates the sky
  S cosine_phi;
  S sine_theta;  //!< sine and cosine of the camera's polar angle
  S cosine_theta;
  DirectionForm<S> energy;          //!< energy at infinity, for an observed energy of 1
  DirectionForm<S> axial_momentum;  //!< L_z of the photon [M]
  DirectionForm<S> outward_rate;    //!< -du/dλ of the ray, backwards; λ: Mino time
  DirectionForm<S> polar_rate;      //!< e_θ · dm/dλ, backwards [M]
  DirectionForm<S> azimuthal_rate;  //!< e_φ · dm/dλ, backwards [M]
  bool ingoing = false;             //!< the camera is inside the horizon or near it; see RayStart
  //! See RayStart; inside the horizon, φ itself is the azimuth of ingoing Kerr coordinates.
  S turn = S(0);
  S lag = S(0);  //!< outer_lag() if `ingoing` [M], otherwise 0
};

using CameraStation = CameraStationOf<double>;

inline namespace ERGO_TARGET {

namespace detail {
//! Returns the sum of 4-momentum components with the given weights, as a form of the observer's
//! direction n.
//!
//! The photon's momentum is (1, -n) in the observer's frame. `weight` applies to (ε, q_r, q_θ,
//! q_φ): the energy and the *reversed* momentum in the target frame of `boost`.
ERGO_HD DirectionForm<double> direction_form(const LorentzTransform& boost, const double (&weight)[4]) {
  double form[4] = {0.0, 0.0, 0.0, 0.0};
  for (int i = 0; i < 4; ++i) {
    const double sign = i == 0 ? 1.0 : -1.0;
    for (int j = 0; j < 4; ++j) {
      form[j] += weight[i] * sign * (j == 0 ? 1.0 : -1.0) * boost.row[i][j];
    }
  }
  return {form[0], {form[1], form[2], form[3]}};
}

template <class T>
ERGO_HD T evaluate(const DirectionForm<ScalarOf<T>>& form, const Vector3<T>& n) {
  return form.constant + (form.along.x * n.x + form.along.y * n.y + form.along.z * n.z);
}

template <class S>
ERGO_HD DirectionForm<S> converted(const DirectionForm<double>& f) {
  return {static_cast<S>(f.constant),
          {static_cast<S>(f.along.x), static_cast<S>(f.along.y), static_cast<S>(f.along.z)}};
}
}  // namespace detail

//! Prepares the camera of an observer at Boyer-Lindquist (r, θ, φ) [M, rad] with the given motion.
//!
//! `given` is the velocity in the ZAMO frame for ObserverMotion::velocity, and in the rain frame
//! for rain_boost. Outside the horizon all motions are supported. `rain` (Doran's free fall from
//! rest at infinity) and `rain_boost` are also valid at the horizon and inside it, down to the
//! inner horizon, because they never use the ZAMO frame. With the rain's speed v and the ZAMO's
//! lapse α = √(1 - v²),
//!   E = ε + v q_r + ω L,      dr/dλ = √A (q_r + v ε)       in the rain frame,
//!   E = α ε + ω L,            dr/dλ = √A α q_r             in the ZAMO frame,
//! which are equal; the rain form has no cancellation.
ERGO_HD CameraStation make_camera_station(Spacetime spacetime, double r, double theta, double phi,
                                          ObserverMotion motion, const Vector3<double>& given = {0.0, 0.0, 0.0}) {
  const KerrFunctions f = kerr_functions(spacetime, r, theta);
  CameraStation station{};
  station.spin = spacetime.spin;
  station.horizon_r = horizon_radius(spacetime);
  station.u = 1.0 / r;
  station.sine_phi = ::sin(phi);
  station.cosine_phi = ::cos(phi);
  station.sine_theta = ::sin(theta);
  station.cosine_theta = ::cos(theta);
  station.ingoing = is_near_horizon(spacetime, r);
  station.turn = station.ingoing && r > station.horizon_r ? ::remainder(ingoing_turn(spacetime, r), 2.0 * pi) : 0.0;
  station.lag = station.ingoing ? outer_lag(spacetime, r) : 0.0;
  const bool in_rain_frame = motion == ObserverMotion::rain || motion == ObserverMotion::rain_boost;
  const double lapse = ::sqrt(f.sigma * f.delta / f.area);
  const double own = in_rain_frame ? 1.0 : lapse;
  const double mixed = in_rain_frame ? f.rain_speed : 0.0;
  const Vector3<double> rest = {0.0, 0.0, 0.0};
  const LorentzTransform boost =
      boost_from_moving_frame(motion == ObserverMotion::rain ? rest
                              : in_rain_frame                ? given
                                                             : observer_velocity(motion, spacetime, r, theta, given));
  const double axial = -f.circumference_factor * station.sine_theta;
  const double radial = ::sqrt(f.area) / (r * r);
  station.energy = detail::direction_form(boost, {own, mixed, 0.0, f.frame_dragging * axial});
  station.axial_momentum = detail::direction_form(boost, {0.0, 0.0, 0.0, axial});
  station.outward_rate = detail::direction_form(boost, {radial * mixed, radial * own, 0.0, 0.0});
  station.polar_rate = detail::direction_form(boost, {0.0, 0.0, ::sqrt(f.sigma), 0.0});
  station.azimuthal_rate = detail::direction_form(boost, {0.0, 0.0, 0.0, f.circumference_factor});
  return station;
}

//! Converts a camera to the precision of a kernel.
template <class S>
ERGO_HD CameraStationOf<S> converted_station(const CameraStation& c) {
  return {static_cast<S>(c.spin),
          static_cast<S>(c.horizon_r),
          static_cast<S>(c.u),
          static_cast<S>(c.sine_phi),
          static_cast<S>(c.cosine_phi),
          static_cast<S>(c.sine_theta),
          static_cast<S>(c.cosine_theta),
          detail::converted<S>(c.energy),
          detail::converted<S>(c.axial_momentum),
          detail::converted<S>(c.outward_rate),
          detail::converted<S>(c.polar_rate),
          detail::converted<S>(c.azimuthal_rate),
          c.ingoing,
          static_cast<S>(c.turn),
          static_cast<S>(c.lag)};
}

//! Returns the light ray that the observer sees in direction `n` (unit vector in the observer's
//! frame: e_r, e_θ, e_φ).
//!
//! T is any real type; a dual number gives exact derivatives of the whole ray. If `energy` <= 0,
//! such light cannot come from infinity (inside the ergosphere), and the other members are
//! meaningless.
template <class T>
ERGO_HD RayStart<T> start_ray(const CameraStationOf<ScalarOf<T>>& camera, const Vector3<T>& n) {
  using S = ScalarOf<T>;
  RayStart<T> ray;
  ray.energy = detail::evaluate(camera.energy, n);
  const T inverse_energy = S(1) / ray.energy;
  ray.axial_angular_momentum = detail::evaluate(camera.axial_momentum, n) * inverse_energy;
  ray.u = T(camera.u);
  ray.u_rate = -(detail::evaluate(camera.outward_rate, n) * inverse_energy);
  const T polar = detail::evaluate(camera.polar_rate, n) * inverse_energy;
  const T azimuthal = detail::evaluate(camera.azimuthal_rate, n) * inverse_energy;
  ray.m = {T(camera.sine_theta), T(S(0)), T(camera.cosine_theta)};
  ray.m_rate = {camera.cosine_theta * polar, azimuthal, -(camera.sine_theta * polar)};
  const S a = camera.spin;
  const S a_cosine = a * camera.cosine_theta;
  ray.polar_constant = polar * polar + azimuthal * azimuthal - a_cosine * a_cosine;
  ray.shear_constant = ray.polar_constant - S(2) * a * ray.axial_angular_momentum + a * a;
  ray.ingoing = camera.ingoing;
  ray.turn = camera.turn;
  return ray;
}

//! Returns the spacetime that a camera is in.
template <class S>
ERGO_HD Spacetime spacetime_of(const CameraStationOf<S>& camera) {
  return Spacetime{static_cast<double>(camera.spin)};
}

//! Returns whether a camera is inside the horizon.
template <class S>
ERGO_HD bool is_within_horizon(const CameraStationOf<S>& camera) {
  return camera.u * camera.horizon_r > S(1);
}

//! Rotates a sky direction of a camera at φ = 0 to the camera's true azimuth.
template <class T>
ERGO_HD Vector3<T> turned_to_camera(const CameraStationOf<ScalarOf<T>>& camera, const Vector3<T>& v) {
  return {camera.cosine_phi * v.x - camera.sine_phi * v.y, camera.sine_phi * v.x + camera.cosine_phi * v.y, v.z};
}

}  // namespace ERGO_TARGET
}  // namespace ergodome
