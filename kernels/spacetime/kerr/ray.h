#pragma once

#include "kernels/core/vector3.h"
#include "kernels/spacetime/spacetime.h"

// Null geodesics: how they start at the camera, and how they end.
namespace ergodome {

//! A null geodesic at the camera, in Mino time that runs backwards: away from the camera, into the
//! past.
//!
//! E = 1; lengths in M. The polar position is the unit vector `m` = (sinθ cosφ, sinθ sinφ, cosθ)
//! with φ = 0 at the camera and without frame dragging, which is the separate angle ψ.
template <class T>
struct RayStart {
  T axial_angular_momentum;  //!< L = L_z / E of the photon [M]; E: its energy at infinity
  T polar_constant;          //!< C = Q + L² = |m'|² - a² m_z² [M²]
  T shear_constant;          //!< K = Q + (L - a)² >= 0 [M²]; Q: Carter's constant
  T u;                       //!< 1 / r [1/M]
  //! Rate du / dλ (λ: Mino time), backwards; u_rate² = 1 + (a² - C) u² + 2 K u³ - a² Q u⁴.
  T u_rate;
  Vector3<T> m;       //!< polar position, |m| = 1
  Vector3<T> m_rate;  //!< dm / dλ, backwards [M]
  T energy;           //!< energy at infinity / energy seen by the observer: g = 1 / energy
  //! The camera is inside the horizon or near it. Azimuths of light that moves only inwards
  //! (negative u_rate) are then in ingoing Kerr coordinates along the way, where nothing is
  //! singular.
  bool ingoing = false;
  //! The camera's azimuth in ingoing Kerr coordinates [rad]; 0 inside the horizon, where camera
  //! azimuths are already in these.
  ScalarOf<T> turn = ScalarOf<T>(0);
};

//! The end of a ray that is followed backwards, where its light comes from.
template <class T>
struct RayEnd {
  Vector3<T> sky;    //!< unit vector to the source (camera at φ = 0); valid for escaped rays
  T mino_time;       //!< Mino time from the camera to infinity for E = 1 [1/M]
  T error_estimate;  //!< the integrator's estimate of the error of `sky` [rad]
};

}  // namespace ergodome
