#pragma once

#include <cstdint>

#include "kernels/core/arithmetic.h"
#include "kernels/core/vector3.h"

namespace ergodome {

//! What became of a ray that was followed from the camera backwards in time.
enum class RayStatus : std::int32_t {
  escaped = 0,       //!< it comes from the celestial sphere
  captured = 1,      //!< it comes from the hole: dark
  not_converged = 2  //!< the integrator ran out of steps before it could tell where on the sky
};

//! A null geodesic at the camera, in Mino time that runs backwards: away from the camera, into the past.
//!
//! E = 1; lengths in M. The polar position is the unit vector `m` = (sinθ cosφ, sinθ sinφ, cosθ) with φ = 0 at the camera and
//! without frame dragging, which is the separate angle ψ.
template <class T>
struct RayStart {
  T axial_angular_momentum;  //!< L = L_z / E of the photon [M]
  T polar_constant;          //!< C = Q + L² = |m'|² - a² m_z² [M²]
  T shear_constant;          //!< K = Q + (L - a)² >= 0 [M²]
  T u;                       //!< 1 / r [1/M]
  T u_rate;                  //!< du / dλ, backwards; u_rate² = 1 + (a² - C) u² + 2 K u³ - a² Q u⁴
  Vector3<T> m;              //!< polar position, |m| = 1
  Vector3<T> m_rate;         //!< dm / dλ, backwards [M]
  T energy;                  //!< energy at infinity over energy seen by the observer: g = 1 / energy
  //! The camera is within the horizon or near to it: azimuths of light that only comes in, whose u_rate is negative, are counted in ingoing Kerr
  //! coordinates on the way, where nothing is singular.
  bool ingoing = false;
  ScalarOf<T> turn =
      ScalarOf<T>(0);  //!< the camera's azimuth in those [rad]; 0 within the horizon, whose cameras have it already
};

//! Where a ray ends.
template <class T>
struct RayEnd {
  Vector3<T> sky;    //!< unit vector to the source on the celestial sphere (camera at φ = 0); valid for escaped rays
  T mino_time;       //!< Mino time from the camera to infinity for E = 1 [1/M]
  T error_estimate;  //!< the integrator's own estimate of the error of `sky` [rad]
};

}  // namespace ergodome
