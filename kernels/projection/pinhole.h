#pragma once

#include "kernels/core/arithmetic.h"
#include "kernels/core/vector3.h"

// The flat screen: a symmetric frustum.
namespace ergodome {

//! Parameters of a pinhole image.
template <class S>
struct Pinhole {
  S half_width;   //!< tangent of half the horizontal field of view
  S half_height;  //!< tangent of half the vertical field of view
};

inline namespace ERGO_TARGET {

//! View direction (x right, y up, z back) at image position (x, y), -1 to 1 across width and height, y up; unit length.
template <class T>
ERGO_HD Vector3<T> direction_from_pinhole(const Pinhole<ScalarOf<T>>& pinhole, const T& x, const T& y) {
  using S = ScalarOf<T>;
  const T right = pinhole.half_width * x;
  const T up = pinhole.half_height * y;
  const T inverse_length = S(1) / sqrt(right * right + up * up + S(1));
  return {right * inverse_length, up * inverse_length, -inverse_length};
}

//! Image position of a view direction in front of the camera; false for one beside or behind it.
ERGO_HD bool pinhole_from_direction(const Pinhole<double>& pinhole, const Vector3<double>& view, double& x, double& y) {
  if (!(view.z < 0.0)) {
    return false;
  }
  x = view.x / (-view.z * pinhole.half_width);
  y = view.y / (-view.z * pinhole.half_height);
  return true;
}

}  // namespace ERGO_TARGET
}  // namespace ergodome
