#pragma once

#include "kernels/core/arithmetic.h"
#include "kernels/core/vector3.h"

// The flat screen: a frustum, symmetric or not, with the screen perpendicular to the view's axis.
namespace ergodome {

//! Parameters of a pinhole image.
template <class S>
struct Pinhole {
  S half_width;   //!< half the width on a screen at distance 1
  S half_height;  //!< half the height on that screen
  S middle_x;     //!< center of the image on that screen, to the right of the view axis
  S middle_y;     //!< center of the image on that screen, upwards from the view axis
};

inline namespace ERGO_TARGET {

//! Returns the view direction (x right, y up, z back; unit length) at image position (x, y), -1 to
//! 1 across width and height, y up.
template <class T>
ERGO_HD Vector3<T> direction_from_pinhole(const Pinhole<ScalarOf<T>>& pinhole, const T& x, const T& y) {
  using S = ScalarOf<T>;
  const T right = pinhole.half_width * x + pinhole.middle_x;
  const T up = pinhole.half_height * y + pinhole.middle_y;
  const T inverse_length = S(1) / sqrt(right * right + up * up + S(1));
  return {right * inverse_length, up * inverse_length, -inverse_length};
}

//! Computes the image position of a view direction: the inverse of direction_from_pinhole(), also
//! for positions outside the image. Returns false for directions at 90° or more from the view axis.
ERGO_HD bool pinhole_from_direction(const Pinhole<double>& pinhole, const Vector3<double>& view, double& x, double& y) {
  if (!(view.z < 0.0)) {
    return false;
  }
  x = (view.x / -view.z - pinhole.middle_x) / pinhole.half_width;
  y = (view.y / -view.z - pinhole.middle_y) / pinhole.half_height;
  return true;
}

}  // namespace ERGO_TARGET
}  // namespace ergodome
