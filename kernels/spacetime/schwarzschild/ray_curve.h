#pragma once

#include "kernels/spacetime/schwarzschild/connecting_ray.h"

// The way of a light ray between its two places. Its orbit is followed from both ends by
//   u'' = 3 u² - u  (that of u'² = 1/b² - u² + 2u³),
// which knows no turning point, with the rates that connecting_ray has: these keep their digits near the critical orbit, where 1/b² alone does
// not tell rays apart, and half the way of a ray lets an error grow by no more than the root of what the whole way would.
namespace ergodome::inline ERGO_TARGET {

//! A place on a ray's way. The way is counted by `share` of the azimuth that it sweeps, so that radial rays, which sweep none, have one too.
struct RayPlace {
  double share;   //!< 0 at the observer, 1 at the point
  double u;       //!< 1/r [1/M]
  double u_rate;  //!< du over dshare: that over dφ, times the azimuth swept [1/M]
};

namespace detail {

//! A radial ray's rate over φ is infinite, and its u runs evenly.
ERGO_HD double rate_over_share(double rate, double angle, double gap) {
  const double over_share = rate * angle;
  return ::fabs(over_share) <= 1e300 ? over_share : gap;
}

}  // namespace detail

//! The end of a ray at the observer; `angle` is the azimuth it sweeps, radii as for connecting_ray.
ERGO_HD RayPlace place_at_observer(const ConnectingRay& ray, double r_observer, double r, double angle) {
  const double gap = 1.0 / r - 1.0 / r_observer;
  return {0.0, 1.0 / r_observer, detail::rate_over_share(ray.rate_at_observer, angle, gap)};
}

//! The end at the point.
ERGO_HD RayPlace place_at_point(const ConnectingRay& ray, double r_observer, double r, double angle) {
  const double gap = 1.0 / r - 1.0 / r_observer;
  return {1.0, 1.0 / r, detail::rate_over_share(ray.rate_at_point, angle, gap)};
}

//! Steps this long lose nothing that doubles hold: the nearest pole of u, where the orbit would end in r = 0, is some ten times as far.
ERGO_HD double longest_ray_step(double angle) { return ::fmin(1.0 / 16.0, 0.1 / ::fmax(angle, 1e-9)); }

//! Goes on along the way by `step` in share, forwards or backwards, no longer than longest_ray_step: Taylor's series of order 16.
ERGO_HD RayPlace moved_on(const RayPlace& from, double angle, double step) {
  constexpr int order = 16;
  double u[order + 1] = {from.u, from.u_rate};
  const double square = angle * angle;
  for (int k = 0; k + 2 <= order; ++k) {
    double product = 0.0;
    for (int i = 0; i <= k; ++i) {
      product += u[i] * u[k - i];
    }
    u[k + 2] = square * (3.0 * product - u[k]) / ((k + 1) * (k + 2));
  }
  RayPlace to{from.share + step, u[order], order * u[order]};
  for (int k = order - 1; k >= 0; --k) {
    to.u = to.u * step + u[k];
    to.u_rate = k > 0 ? to.u_rate * step + k * u[k] : to.u_rate;
  }
  return to;
}

}  // namespace ergodome::inline ERGO_TARGET
