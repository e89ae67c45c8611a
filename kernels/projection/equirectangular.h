#pragma once

#include "kernels/core/arithmetic.h"
#include "kernels/core/vector3.h"

// The sphere, or a sector between two meridians, on an image: azimuth to the right, elevation from
// pole to pole upwards, forward in the middle.
namespace ergodome {

//! Parameters of an equirectangular image.
template <class S>
struct Equirectangular {
  S half_azimuth;  //!< azimuth at the right side [rad], up to π
};

inline namespace ERGO_TARGET {

//! Returns the view direction (x right, y up, z back; unit length) at image position (x, y), -1 to
//! 1 across width and height, y up.
template <class T>
ERGO_HD Vector3<T> direction_from_equirectangular(const Equirectangular<ScalarOf<T>>& image, const T& x, const T& y) {
  using S = ScalarOf<T>;
  T azimuth_sine;
  T azimuth_cosine;
  T elevation_sine;
  T elevation_cosine;
  sine_cosine(image.half_azimuth * x, azimuth_sine, azimuth_cosine);
  sine_cosine(S(1.57079632679489661923) * y, elevation_sine, elevation_cosine);
  return {elevation_cosine * azimuth_sine, elevation_sine, -(elevation_cosine * azimuth_cosine)};
}

//! Computes the image position of a view direction: the inverse of
//! direction_from_equirectangular(). At the poles x is 0.
ERGO_HD void equirectangular_from_direction(const Equirectangular<double>& image, const Vector3<double>& view,
                                            double& x, double& y) {
  x = ::atan2(view.x, -view.z) / image.half_azimuth;
  y = ::atan2(view.y, ::sqrt(view.x * view.x + view.z * view.z)) / 1.57079632679489661923;
}

}  // namespace ERGO_TARGET
}  // namespace ergodome
