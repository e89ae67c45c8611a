#pragma once

#include "kernels/core/vector3.h"
#include "kernels/projection/lens_law.h"

// The dome's fisheye (domemaster, AFDI/IMERSA: there equidistant). The circle is inscribed in the
// square, as seen from inside, looking up. The front of the dome is at the bottom of the image,
// right is right.
namespace ergodome {

//! Parameters of a fisheye image. Its points are points of the dome, a sphere of radius 1 about the
//! origin of the view's axes.
template <class S>
struct DomeFisheye {
  FisheyeLens<S> lens;
  S tilt_sine;  //!< sine of the tilt of the dome's top to the front
  S tilt_cosine;
  //! Position of the viewer's eye relative to the dome's center, in dome radii.
  Vector3<S> viewer;
  std::int32_t off_centre;  //!< 1 if `viewer` is not the center
  std::int32_t truncated;   //!< 1 if parts of the square are cut off by `lowest` or `highest`
  S lowest;                 //!< image y (-1 to 1, upwards) below which the image is black
  S highest;                //!< image y above which the image is black
};

inline namespace ERGO_TARGET {

namespace detail {
//! Returns the point of the dome at image position (x, y), in view axes. Its component along the
//! axis through the dome's top is `cosine`, the one perpendicular to it `outwards` times (x, y).
template <class T>
ERGO_HD Vector3<T> tilted_down(const DomeFisheye<ScalarOf<T>>& dome, const T& outwards, const T& cosine, const T& x,
                               const T& y) {
  const T right = outwards * x;
  const T front = -(outwards * y);
  // The zenith tilts to the front, the front goes down.
  const T up = dome.tilt_cosine * cosine - dome.tilt_sine * front;
  const T forward = dome.tilt_sine * cosine + dome.tilt_cosine * front;
  return {right, up, -forward};
}
}  // namespace detail

//! Returns the view direction (x right, y up, z back; unit length) at image position (x, y), -1 to
//! 1 across the square, y up.
//!
//! Positions outside the circle continue the same map.
template <class T>
ERGO_HD Vector3<T> direction_from_fisheye(const DomeFisheye<ScalarOf<T>>& dome, const T& x, const T& y) {
  using S = ScalarOf<T>;
  T outwards;
  T cosine;
  look_through_lens(dome.lens, x, y, outwards, cosine);
  const Vector3<T> position = detail::tilted_down(dome, outwards, cosine, x, y);
  if (dome.off_centre == 0) {
    return position;
  }
  const Vector3<T> way = {position.x - dome.viewer.x, position.y - dome.viewer.y, position.z - dome.viewer.z};
  return (S(1) / sqrt(dot(way, way))) * way;
}

//! Returns whether the dome is equidistant and seen from its center, as nearly all domes are.
template <class S>
ERGO_HD bool is_plain(const DomeFisheye<S>& dome) {
  return dome.lens.law == LensLaw::equidistant && dome.off_centre == 0;
}

//! Returns the view direction at image position (x, y) for a plain dome.
template <class T>
ERGO_HD Vector3<T> direction_from_plain_fisheye(const DomeFisheye<ScalarOf<T>>& dome, const T& x, const T& y) {
  T outwards;
  T cosine;
  look_through_plain_lens(dome.lens, x, y, outwards, cosine);
  return detail::tilted_down(dome, outwards, cosine, x, y);
}

//! Returns the point of the dome that a viewer sees in a direction: where the ray meets the sphere.
//! Both have unit length.
ERGO_HD Vector3<double> position_on_dome(const DomeFisheye<double>& dome, const Vector3<double>& view) {
  if (dome.off_centre == 0) {
    return view;
  }
  const double along = dot(dome.viewer, view);
  const double distance = ::sqrt(along * along + 1.0 - dot(dome.viewer, dome.viewer)) - along;
  return dome.viewer + distance * view;
}

//! Computes the image position of a view direction: the inverse of direction_from_fisheye(). The
//! point opposite to the dome's top has no single position and is put at the front. Returns false
//! where the lens has no image of the direction.
ERGO_HD bool fisheye_from_direction(const DomeFisheye<double>& dome, const Vector3<double>& view, double& x,
                                    double& y) {
  const Vector3<double> position = position_on_dome(dome, view);
  const double forward = -position.z;
  const double zenith = dome.tilt_cosine * position.y + dome.tilt_sine * forward;
  const double front = dome.tilt_cosine * forward - dome.tilt_sine * position.y;
  const double across = ::sqrt(position.x * position.x + front * front);
  double radius = 0.0;
  if (!lens_radius(dome.lens, zenith, across, radius)) {
    return false;
  }
  x = across > 0.0 ? radius * position.x / across : 0.0;
  y = across > 0.0 ? -radius * front / across : -radius;
  return true;
}

//! Returns the fraction of a pixel that the image covers: 1, falling to 0 across the rim of the
//! circle and along a cut. (x, y) is in pixels from the center of the square, y down; `half_width`
//! is half the width of the square in pixels.
template <class T>
ERGO_HD T fisheye_coverage(const DomeFisheye<ScalarOf<T>>& dome, ScalarOf<T> half_width, const T& x, const T& y) {
  using S = ScalarOf<T>;
  T inside = (dome.lens.rim * half_width + S(0.5)) - sqrt(x * x + y * y);
  if (dome.truncated != 0) {
    const T above_cut = (S(0.5) - dome.lowest * half_width) - y;
    const T below_cut = (dome.highest * half_width + S(0.5)) + y;
    inside = minimum(inside, minimum(above_cut, below_cut));
  }
  return minimum(maximum(inside, T(S(0))), T(S(1)));
}

template <class S>
ERGO_HD DomeFisheye<S> converted_dome(const DomeFisheye<double>& dome) {
  return {converted_lens<S>(dome.lens),
          static_cast<S>(dome.tilt_sine),
          static_cast<S>(dome.tilt_cosine),
          {static_cast<S>(dome.viewer.x), static_cast<S>(dome.viewer.y), static_cast<S>(dome.viewer.z)},
          dome.off_centre,
          dome.truncated,
          static_cast<S>(dome.lowest),
          static_cast<S>(dome.highest)};
}

}  // namespace ERGO_TARGET
}  // namespace ergodome
