#pragma once

#include "content/camera/camera_path.h"
#include "kernels/spacetime/kerr/camera_station.h"

namespace ergodome {

//! One eye at one instant: an event in a spacetime, the observer's motion there, and the
//! directions of the view's axes.
struct EyeCamera {
  Spacetime spacetime;
  double r;      //!< Boyer-Lindquist radius [M]
  double theta;  //!< polar angle [rad]
  double phi;    //!< azimuth [rad]; inside the horizon, of ingoing Kerr coordinates
  ObserverMotion motion;
  //! Velocity of the observer: in the ZAMO frame for ObserverMotion::velocity, in the rain frame
  //! for rain_boost.
  Vector3<double> velocity{};
  //! Rotation whose columns are the view's x (right), y (up), z (back) in (e_r, e_θ, e_φ).
  double frame_from_view[3][3];
  double head_r;      //!< Boyer-Lindquist radius of the head; for a single eye its own [M]
  double head_theta;  //!< polar angle of the head [rad]
  //! CameraPose::clock_lead for this eye [M]: Boyer-Lindquist time minus the show's time, for an
  //! eye of a head that falls through the horizon; otherwise 0.
  double clock_lead = 0.0;
};

//! Returns an eye of the show's camera at a pose, at `offset` [M] from the head in the view's axes
//! (x right, y up, z back). Throws Error inside the horizon for cameras that do not fall there,
//! near the inner horizon, if the observer would be faster than light, and for NaN.
EyeCamera eye_camera(const Show& show, const CameraPose& pose, const Vector3<double>& offset);

//! Returns an eye of the show's camera at a pose, at the distance `to_the_right` [M] from the head
//! along the view's x axis; 0 is the head itself. Throws Error like the overload above.
inline EyeCamera eye_camera(const Show& show, const CameraPose& pose, double to_the_right) {
  return eye_camera(show, pose, {to_the_right, 0.0, 0.0});
}

//! Returns an eye's pseudo-Cartesian position [M].
Vector3<double> position_of(const EyeCamera& eye);

//! Transforms a vector of the observer's frame into the view's axes.
inline Vector3<double> in_view(const EyeCamera& eye, const Vector3<double>& v) {
  const double(&m)[3][3] = eye.frame_from_view;
  return {m[0][0] * v.x + m[1][0] * v.y + m[2][0] * v.z, m[0][1] * v.x + m[1][1] * v.y + m[2][1] * v.z,
          m[0][2] * v.x + m[1][2] * v.y + m[2][2] * v.z};
}

}  // namespace ergodome
