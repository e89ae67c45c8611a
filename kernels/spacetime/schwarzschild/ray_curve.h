#pragma once

#include "kernels/spacetime/schwarzschild/connecting_ray.h"

// Points on a light ray between its two ends. The orbit is followed from both ends by
//   u'' = 3 u² - u  (from u'² = 1/b² - u² + 2u³),
// which is regular at turning points, with the rates of connecting_ray(). These are accurate near
// the critical orbit, where 1/b² alone does not resolve rays. Over half of a ray, an error grows by
// only the square root of its growth over the whole ray.
namespace ergodome::inline ERGO_TARGET {

//! A point on a ray. Its coordinate is the `share` of the azimuth that the ray sweeps, which is
//! also defined for radial rays, which sweep none.
struct RayPosition {
  double share;   //!< 0 at the observer, 1 at the point
  double u;       //!< 1/r [1/M]
  double u_rate;  //!< du / dshare = du/dφ times the azimuth that is swept [1/M]
};

namespace detail {

//! Converts du/dφ to du/dshare. For a radial ray du/dφ is infinite; its u is linear in the share,
//! with the slope `gap`.
ERGO_HD double rate_over_share(double rate, double angle, double gap) {
  const double over_share = rate * angle;
  return ::fabs(over_share) <= 1e300 ? over_share : gap;
}

}  // namespace detail

//! Returns the RayPosition of a ray's end at the observer. `angle` is the azimuth that it sweeps,
//! radii as for connecting_ray().
ERGO_HD RayPosition position_at_observer(const ConnectingRay& ray, double r_observer, double r, double angle) {
  const double gap = 1.0 / r - 1.0 / r_observer;
  return {0.0, 1.0 / r_observer, detail::rate_over_share(ray.rate_at_observer, angle, gap)};
}

//! Returns the RayPosition of a ray's end at the point.
ERGO_HD RayPosition position_at_point(const ConnectingRay& ray, double r_observer, double r, double angle) {
  const double gap = 1.0 / r - 1.0 / r_observer;
  return {1.0, 1.0 / r, detail::rate_over_share(ray.rate_at_point, angle, gap)};
}

//! Returns the largest step in share for which the Taylor series of moved_on() is exact in double:
//! the nearest pole of u, where the orbit would end at r = 0, is about ten times as far away.
//! `angle`: the azimuth that the ray sweeps [rad].
ERGO_HD double longest_ray_step(double angle) { return ::fmin(1.0 / 16.0, 0.1 / ::fmax(angle, 1e-9)); }

//! Moves along a ray by `step` in share, forwards or backwards, at most longest_ray_step(): Taylor
//! series of order 16.
ERGO_HD RayPosition moved_on(const RayPosition& from, double angle, double step) {
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
  RayPosition to{from.share + step, u[order], order * u[order]};
  for (int k = order - 1; k >= 0; --k) {
    to.u = to.u * step + u[k];
    to.u_rate = k > 0 ? to.u_rate * step + k * u[k] : to.u_rate;
  }
  return to;
}

}  // namespace ergodome::inline ERGO_TARGET
