#pragma once

#include "kernels/near_rays/near_ray.h"
#include "kernels/spacetime/geodesic/taylor.h"

namespace ergodome::inline ERGO_TARGET {

//! Quantities that are carried along a ray in addition to 1/r and m_z = cosθ.
enum class NearParts {
  position_alone,
  distance,
  azimuth,
  azimuth_and_delay,
  azimuth_and_distance,
  azimuth_delay_and_distance
};

constexpr bool has_azimuth(NearParts parts) { return parts >= NearParts::azimuth; }
constexpr bool has_delay(NearParts parts) {
  return parts == NearParts::azimuth_and_delay || parts == NearParts::azimuth_delay_and_distance;
}
//! Returns whether the affine distance (kernels/spacetime/geodesic/affine_distance.h) is carried
//! along rays.
constexpr bool has_distance(NearParts parts) {
  return parts == NearParts::distance || parts == NearParts::azimuth_and_distance ||
         parts == NearParts::azimuth_delay_and_distance;
}

namespace detail {

//! The Taylor series of a ray in scaled time. `Parts` selects the quantities that have a series.
template <int Order, class T, NearParts Parts>
struct NearSeries {
  T u[Order + 1];
  T z[Order + 1];
  T x[has_azimuth(Parts) ? Order + 1 : 1];
  T y[has_azimuth(Parts) ? Order + 1 : 1];
  T drag[has_azimuth(Parts) ? Order + 1 : 1];
  T delay[has_delay(Parts) ? Order + 1 : 1];
  T distance[has_distance(Parts) ? Order + 1 : 1];
};

//! Constants of a ray as the recurrences use them. Time is Mino time times s = 1 / inverse_scale.
//! For E, C, K and Q see NearRay.
template <class T>
struct NearCoefficients {
  T linear;       //!< (a² E² - C) / s², for both u and z; s = 1 / inverse_scale
  T u_quadratic;  //!< 3 K / s²; s = 1 / inverse_scale
  T u_cubic;      //!< -2 a² Q / s²; s = 1 / inverse_scale
  T polar;        //!< C / s²; C: polar constant, s = 1 / inverse_scale
  T spring;       //!< a² E² / s²; s = 1 / inverse_scale
  RealOf<T> inverse_scale;
  //! Lanes whose azimuth and time are in ingoing Kerr coordinates, as counts_ingoing() returns
  //! them.
  MaskOf<RealOf<T>> ingoing;
};

}  // namespace detail

}  // namespace ergodome::inline ERGO_TARGET
