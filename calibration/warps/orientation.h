#pragma once

#include "kernels/core/vector3.h"

namespace ergodome {

//! Rotation of a projector that initially faces the front: to the right by yaw, then up by pitch,
//! then around its own axis by roll, clockwise as seen from behind it (VESA MPCDI 2.0, table 2-1).
struct Orientation {
  double yaw_deg = 0.0;
  double pitch_deg = 0.0;
  double roll_deg = 0.0;
};

//! A projector's axes in the dome's axes (x right, y up, z back); unit vectors.
struct ProjectorAxes {
  Vector3<double> right;
  Vector3<double> up;
  Vector3<double> forward;
};

ProjectorAxes axes_of(const Orientation& orientation);

//! Returns the orientation with these axes: yaw and roll from -180 to 180, pitch from -90 to 90.
//! Straight up or down, where yaw and roll have the same effect, roll is 0.
Orientation orientation_of(const ProjectorAxes& axes);

//! The half angles of a flat lens's image [deg]: right and up are positive, left and down negative
//! if the axis is inside the image.
struct Frustum {
  double left_deg = -30.0;
  double right_deg = 30.0;
  double up_deg = 20.0;
  double down_deg = -20.0;
};

//! Returns the direction (not normalized) in which a flat lens shows position (x, y) of its raster,
//! 0 to 1, y down.
Vector3<double> direction_from_raster(const ProjectorAxes& axes, const Frustum& frustum, double x, double y);

}  // namespace ergodome
