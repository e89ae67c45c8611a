#pragma once

#include <variant>
#include <vector>

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
//! if the lens axis is inside the image.
struct Frustum {
  double left_deg = -30.0;
  double right_deg = 30.0;
  double up_deg = 20.0;
  double down_deg = -20.0;
};

//! Returns the direction (not normalized) in which a flat lens shows position (x, y) of its raster,
//! 0 to 1, y down.
Vector3<double> direction_from_raster(const ProjectorAxes& axes, const Frustum& frustum, double x, double y);

//! A fisheye lens: radius as an odd polynomial of the angle from the lens axis, or proportional to
//! it.
struct ProjectorFisheye {
  double field_of_view_deg = 180.0;  //!< full angle across the image circle
  double circle = 1.0;  //!< diameter of the image circle in raster heights; for lenses without a polynomial
  std::vector<double>
      polynomial;  //!< f1, f3, f5, f7: r = f1 t + f3 t^3 + ..., t in rad, r in half-widths of the raster
  //! Offset of the lens axis from the center of the raster, to the right in half-widths.
  double offset_x = 0.0;
  double offset_y = 0.0;  //!< offset of the lens axis upwards, in half-heights
};

//! A lens: none (only the warp defines the projection), flat, or fisheye.
using Lens = std::variant<std::monostate, Frustum, ProjectorFisheye>;

//! Returns the angle from the lens axis up to which a polynomial f1 t + f3 t^3 + ... increases
//! [rad]; at most π.
double growing_angle(const std::vector<double>& polynomial);

}  // namespace ergodome
