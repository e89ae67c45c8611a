#pragma once

#include "kernels/core/arithmetic.h"
#include "kernels/core/vector3.h"

// The upright cylinder about the viewer, unrolled: azimuth to the right, height on the cylinder
// (the tangent of the elevation) upwards, forward in the middle.
namespace ergodome {

//! Parameters of a cylindrical image.
template <class S>
struct Cylinder {
  S half_azimuth;   //!< azimuth at the right side [rad], up to π
  S middle_height;  //!< tangent of the elevation in the middle of the image
  S half_height;    //!< change of that tangent from the middle to the top
};

inline namespace ERGO_TARGET {

//! Returns the view direction (x right, y up, z back; unit length) at image position (x, y), -1 to
//! 1 across width and height, y up.
template <class T>
ERGO_HD Vector3<T> direction_from_cylinder(const Cylinder<ScalarOf<T>>& cylinder, const T& x, const T& y) {
  using S = ScalarOf<T>;
  T sine;
  T cosine;
  sine_cosine(cylinder.half_azimuth * x, sine, cosine);
  const T height = cylinder.half_height * y + cylinder.middle_height;
  const T level = S(1) / sqrt(height * height + S(1));
  return {level * sine, level * height, -(level * cosine)};
}

//! Computes the image position of a view direction: the inverse of direction_from_cylinder().
//! Returns false for straight up and down, which the cylinder never reaches.
ERGO_HD bool cylinder_from_direction(const Cylinder<double>& cylinder, const Vector3<double>& view, double& x,
                                     double& y) {
  const double level = ::sqrt(view.x * view.x + view.z * view.z);
  if (!(level > 0.0)) {
    return false;
  }
  x = ::atan2(view.x, -view.z) / cylinder.half_azimuth;
  y = (view.y / level - cylinder.middle_height) / cylinder.half_height;
  return true;
}

}  // namespace ERGO_TARGET
}  // namespace ergodome
