#pragma once

#include "kernels/core/arithmetic.h"
#include "kernels/core/vector3.h"

// The dome's equidistant fisheye (domemaster, AFDI/IMERSA): the circle is inscribed in the square and touches its sides; as seen
// from inside, looking up; the front of the dome is at the bottom of the image, right is right.
namespace ergodome {

//! Parameters of a fisheye image.
template <class S>
struct DomeFisheye {
  S half_angle;  //!< zenith angle at the rim of the circle [rad], up to π
  S tilt_sine;   //!< how far the dome's top leans to the front
  S tilt_cosine;
};

inline namespace ERGO_TARGET {

//! View direction (x right, y up, z back) at image position (x, y), -1 to 1 across the square, y up; unit length.
//!
//! Zenith angle = radius · half_angle. Positions outside the circle continue the same map.
template <class T>
ERGO_HD Vector3<T> direction_from_fisheye(const DomeFisheye<ScalarOf<T>>& dome, const T& x, const T& y) {
  using S = ScalarOf<T>;
  // Far below the resolution of any image, and keeps 0 / 0 away from the centre.
  const T radius = sqrt(x * x + y * y + S(1e-20));
  T sine;
  T cosine;
  sine_cosine(dome.half_angle * radius, sine, cosine);
  const T outwards = sine / radius;
  const T right = outwards * x;
  const T front = -(outwards * y);
  // The zenith leans to the front, the front goes down.
  const T up = dome.tilt_cosine * cosine - dome.tilt_sine * front;
  const T forward = dome.tilt_sine * cosine + dome.tilt_cosine * front;
  return {right, up, -forward};
}

//! Image position of a view direction: the inverse; the antipode of the zenith has no single position.
ERGO_HD void fisheye_from_direction(const DomeFisheye<double>& dome, const Vector3<double>& view, double& x,
                                    double& y) {
  const double forward = -view.z;
  const double zenith = dome.tilt_cosine * view.y + dome.tilt_sine * forward;
  const double front = dome.tilt_cosine * forward - dome.tilt_sine * view.y;
  const double across = ::sqrt(view.x * view.x + front * front);
  const double radius = ::atan2(across, zenith) / dome.half_angle;
  x = across > 0.0 ? radius * view.x / across : 0.0;
  y = across > 0.0 ? -radius * front / across : 0.0;
}

}  // namespace ERGO_TARGET
}  // namespace ergodome
