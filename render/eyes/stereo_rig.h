#pragma once

#include "kernels/core/vector3.h"
#include "kernels/spacetime/spacetime.h"

// Places eyes relative to a head.

namespace ergodome {

//! Position and axes of an eye, derived from the head's.
struct EyeEvent {
  double r;      //!< Boyer-Lindquist radius [M]
  double theta;  //!< polar angle [rad]
  //! Azimuth [rad]; inside the horizon, of ingoing Kerr coordinates, like the head's.
  double phi;
  //! Rotation whose columns are the view's x (right), y (up), z (back) in (e_r, e_θ, e_φ) at the
  //! eye.
  double frame_from_view[3][3];
};

//! Limits for eye positions, and the frame in which lengths are measured.
struct EyeRoom {
  double min_r;  //!< minimum radius; an eye closer to the hole is moved out to it [M]
  //! Lengths are measured in the rain frame instead of the ZAMO frame; eyes may be inside the
  //! horizon.
  bool in_rain = false;
};

//! Computes the event of an eye at `offset` [M] from the head, in the view's axes (x right, y up, z
//! back). `frame_from_view`: the head's axes at (r, θ, φ).
//!
//! The metric turns the offset's proper length in the head's frame into a coordinate displacement,
//! which follows a straight line of the Cartesian-like coordinates x = r sinθ cosφ, ... This works
//! across the spin axis and for any length. The eye's axes stay parallel to the head's in those
//! coordinates.
EyeEvent eye_event(Spacetime spacetime, double r, double theta, double phi, const double (&frame_from_view)[3][3],
                   const Vector3<double>& offset, const EyeRoom& room);

}  // namespace ergodome
