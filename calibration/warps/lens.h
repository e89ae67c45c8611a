#pragma once

#include <variant>
#include <vector>

#include "calibration/warps/orientation.h"

namespace ergodome {

//! A fisheye lens: radius as an odd polynomial of the angle from the axis, or proportional to it.
struct ProjectorFisheye {
  double field_of_view_deg = 180.0;  //!< full angle across the image circle
  double circle = 1.0;  //!< diameter of the image circle in raster heights; for lenses without a polynomial
  std::vector<double>
      polynomial;         //!< f1, f3, f5, f7: r = f1 t + f3 t^3 + ..., t in rad, r in half-widths of the raster
  double offset_x = 0.0;  //!< of the axis from the center of the raster, to the right in half-widths
  double offset_y = 0.0;  //!< likewise up, in half-heights
};

//! A lens: none (only the warp defines the projection), flat, or fisheye.
using Lens = std::variant<std::monostate, Frustum, ProjectorFisheye>;

//! Returns the angle from the axis up to which a polynomial f1 t + f3 t^3 + ... increases [rad]; at
//! most π.
double growing_angle(const std::vector<double>& polynomial);

}  // namespace ergodome
