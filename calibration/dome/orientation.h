#pragma once

#include "kernels/core/vector3.h"

namespace ergodome {

//! How a projector is turned from looking to the front: to the right by yaw, then up by pitch, then about its own axis by roll,
//! clockwise as seen from behind it (VESA MPCDI 2.0, table 2-1).
struct Orientation {
  double yaw_deg = 0.0;
  double pitch_deg = 0.0;
  double roll_deg = 0.0;
};

//! A projector's own axes in the dome's (x right, y up, z back); unit vectors.
struct ProjectorAxes {
  Vector3<double> right;
  Vector3<double> up;
  Vector3<double> forward;
};

ProjectorAxes axes_of(const Orientation& orientation);

//! The inverse: yaw and roll from -180 to 180, pitch from -90 to 90. Straight up or down, where they turn about one axis, roll is 0.
Orientation orientation_of(const ProjectorAxes& axes);

//! The half angles of a flat lens's picture [deg]: right and up count positive, left and down negative when the axis is within it.
struct Frustum {
  double left_deg = -30.0;
  double right_deg = 30.0;
  double up_deg = 20.0;
  double down_deg = -20.0;
};

//! The direction (not of unit length) in which a flat lens shows position (x, y) of its raster, 0 to 1, y down.
Vector3<double> direction_from_raster(const ProjectorAxes& axes, const Frustum& frustum, double x, double y);

}  // namespace ergodome
