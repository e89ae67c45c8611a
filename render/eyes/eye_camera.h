#pragma once

#include "content/camera/camera_path.h"
#include "kernels/spacetime/kerr/camera_station.h"

namespace ergodome {

//! One eye at one instant: an event in the hole's spacetime, the observer's motion there, and where the view's axes point.
struct EyeCamera {
  double spin;   //!< [M]
  double r;      //!< Boyer-Lindquist radius [M]
  double theta;  //!< polar angle [rad]
  double phi;    //!< azimuth [rad]; within the horizon that of ingoing Kerr coordinates
  ObserverMotion motion;
  Vector3<double> velocity{};    //!< in the ZAMO frame for ObserverMotion::velocity, in the rain's for rain_boost
  double frame_from_view[3][3];  //!< columns: the view's x (right), y (up), z (back) in (e_r, e_θ, e_φ)
  double head_r;                 //!< the head's place: the eye's own for a single eye [M]
  double head_theta;             //!< [rad]
  double clock_lead = 0.0;       //!< as CameraPose's, of this eye [M]
};

//! An eye of the show's camera at a pose, `offset` M from the head in the view's axes (x right, y up, z back). Throws Error within the
//! horizon for cameras that do not fall there, near the inner one, where the observer would outrun light, and for numbers that are none.
EyeCamera eye_camera(const Show& show, const CameraPose& pose, const Vector3<double>& offset);

//! The same for an eye to the right of the head; 0 is the head itself.
inline EyeCamera eye_camera(const Show& show, const CameraPose& pose, double to_the_right) {
  return eye_camera(show, pose, {to_the_right, 0.0, 0.0});
}

//! Where an eye is, pseudo-Cartesian [M].
Vector3<double> place_of(const EyeCamera& eye);

//! A vector of the observer's frame in the view's axes.
inline Vector3<double> in_view(const EyeCamera& eye, const Vector3<double>& v) {
  const double(&m)[3][3] = eye.frame_from_view;
  return {m[0][0] * v.x + m[1][0] * v.y + m[2][0] * v.z, m[0][1] * v.x + m[1][1] * v.y + m[2][1] * v.z,
          m[0][2] * v.x + m[1][2] * v.y + m[2][2] * v.z};
}

}  // namespace ergodome
