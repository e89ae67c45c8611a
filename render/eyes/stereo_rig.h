#pragma once

#include "kernels/core/vector3.h"

namespace ergodome {

//! An eye's event and axes, from the head's.
struct EyeEvent {
  double r;                      //!< [M]
  double theta;                  //!< [rad]
  double phi;                    //!< [rad]; within the horizon, like the head's there, that of ingoing Kerr coordinates
  double frame_from_view[3][3];  //!< columns: the view's x (right), y (up), z (back) in the eye's own (e_r, e_θ, e_φ)
};

//! Where eyes may be, and who measures how far.
struct EyeRoom {
  double least_r;        //!< an eye that would come closer to the hole stays there [M]
  bool in_rain = false;  //!< lengths are those of the rain's frame, not the ZAMO's, and eyes may be within the horizon
};

//! Where an eye is that sits at `offset` [M] from the head, in the view's axes (x right, y up, z back).
//!
//! The offset's proper length in the head's frame becomes a coordinate displacement through the metric, carried along a straight line of the Cartesian-like coordinates x = r sinθ cosφ, ..., so it works across the spin
//! axis and for any length. The eye's axes stay parallel to the head's in those coordinates. `frame_from_view` are the head's axes at (r, θ, φ).
EyeEvent eye_event(double spin, double r, double theta, double phi, const double (&frame_from_view)[3][3],
                   const Vector3<double>& offset, const EyeRoom& room);

}  // namespace ergodome
