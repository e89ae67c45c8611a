#pragma once

#include "kernels/core/vector3.h"
#include "kernels/spacetime/kerr/kerr.h"

// Motions of observers, and Lorentz transforms between their frames.
namespace ergodome {

//! How the observer moves. Every observer's frame is the frame of the zero-angular-momentum
//! observer (ZAMO: e_r, e_θ, e_φ), boosted by the observer's velocity without rotation, unless
//! noted below.
enum class ObserverMotion {
  zamo,        //!< zero angular momentum: rotates with the dragged space
  fixed,       //!< at rest relative to the stars; outside the ergosphere only
  geodesic,    //!< circular equatorial orbit along +φ at the coordinate radius r
  retrograde,  //!< circular equatorial orbit along -φ
  rain,        //!< free fall from rest at infinity, without angular momentum
  velocity,    //!< any velocity in the ZAMO frame
  //! Any velocity in the rain frame. The observer's frame is the rain frame, not the ZAMO's,
  //! boosted by it. Also valid at the horizon and inside it.
  rain_boost
};

//! A linear map of 4-vectors (energy first, then r, θ, φ components), stored by rows.
struct LorentzTransform {
  double row[4][4];
};

inline namespace ERGO_TARGET {

//! Returns the velocity of an observer in the ZAMO frame, in units of c.
//!
//! `given` is used for ObserverMotion::velocity and rain_boost only. The speed is at least 1 or NaN
//! where such an observer cannot exist (at rest in the ergosphere, circular inside the photon
//! orbit) and inside the horizon, where no ZAMO exists; callers must check.
ERGO_HD Vector3<double> observer_velocity(ObserverMotion motion, Spacetime spacetime, double r, double theta,
                                          const Vector3<double>& given) {
  const KerrFunctions f = kerr_functions(spacetime, r, theta);
  const auto along_phi = [&](double angular_velocity) {
    // Proper circumference per lapse: A sinθ / (Σ √Δ). Bardeen, Press & Teukolsky (1972), eq. 3.10.
    return Vector3<double>{0.0, 0.0,
                           (angular_velocity - f.frame_dragging) * f.area * ::sin(theta) / (f.sigma * ::sqrt(f.delta))};
  };
  switch (motion) {
    case ObserverMotion::zamo:
      return {0.0, 0.0, 0.0};
    case ObserverMotion::fixed:
      return along_phi(0.0);
    case ObserverMotion::geodesic:
      return along_phi(1.0 / (r * ::sqrt(r) + spacetime.spin));
    case ObserverMotion::retrograde:
      return along_phi(-1.0 / (r * ::sqrt(r) - spacetime.spin));
    case ObserverMotion::rain:
      return {-f.rain_speed, 0.0, 0.0};
    case ObserverMotion::rain_boost: {
      const double lapse = ::sqrt(f.sigma * f.delta / f.area);
      const double shared = 1.0 / (1.0 - f.rain_speed * given.x);
      return {shared * (given.x - f.rain_speed), shared * lapse * given.y, shared * lapse * given.z};
    }
    case ObserverMotion::velocity:
      break;
  }
  return given;
}

//! Returns the map from components of a 4-vector in a frame that moves at velocity β (|β| < 1) to
//! its components in the frame at rest.
ERGO_HD LorentzTransform boost_from_moving_frame(const Vector3<double>& beta) {
  const double b[3] = {beta.x, beta.y, beta.z};
  const double b2 = dot(beta, beta);
  const double gamma = 1.0 / ::sqrt(1.0 - b2);
  // (γ - 1) / β² without cancellation at small β.
  const double stretch = gamma * gamma / (gamma + 1.0);
  LorentzTransform boost{};
  boost.row[0][0] = gamma;
  for (int i = 0; i < 3; ++i) {
    boost.row[0][i + 1] = gamma * b[i];
    boost.row[i + 1][0] = gamma * b[i];
    for (int j = 0; j < 3; ++j) {
      boost.row[i + 1][j + 1] = (i == j ? 1.0 : 0.0) + stretch * b[i] * b[j];
    }
  }
  return boost;
}

ERGO_HD LorentzTransform operator*(const LorentzTransform& a, const LorentzTransform& b) {
  LorentzTransform product{};
  for (int i = 0; i < 4; ++i) {
    for (int j = 0; j < 4; ++j) {
      for (int k = 0; k < 4; ++k) {
        product.row[i][j] += a.row[i][k] * b.row[k][j];
      }
    }
  }
  return product;
}

//! Returns the Wigner rotation from the axes of an observer that is boosted from the ZAMO frame to
//! the axes of one with the same motion that is boosted from the rain frame. `in_zamo` and
//! `in_rain` are the velocity of this motion in the two frames. Valid outside the horizon.
ERGO_HD LorentzTransform rain_axes_from_zamo_axes(Spacetime spacetime, double r, double theta,
                                                  const Vector3<double>& in_zamo, const Vector3<double>& in_rain) {
  const Vector3<double> falls = observer_velocity(ObserverMotion::rain, spacetime, r, theta, {0.0, 0.0, 0.0});
  return boost_from_moving_frame({-in_rain.x, -in_rain.y, -in_rain.z}) *
         (boost_from_moving_frame({-falls.x, -falls.y, -falls.z}) * boost_from_moving_frame(in_zamo));
}

}  // namespace ERGO_TARGET
}  // namespace ergodome
