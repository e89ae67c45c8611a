#pragma once

#include "kernels/core/angles.h"
#include "kernels/core/dual.h"
#include "kernels/spacetime/geodesic/radial_potential.h"
#include "kernels/spacetime/shadow/shadow_chart.h"

// The edge of the shadow on a camera's sky, solved in double.
namespace ergodome::inline ERGO_TARGET {

//! Returns the angle at which the sky turns bright along a great circle that is dark at 0 and
//! bright at `bright_limit` [rad].
//!
//! `chart` and `gamma` define the circle. The ray's darkness passes through zero linearly at the
//! edge. Newton's method (with an exact derivative, by dual numbers) inside a shrinking bracket
//! finds the root to rounding.
ERGO_HD double edge_along_circle(const CameraStation& camera, const ShadowChart& chart, double gamma,
                                 double bright_limit) {
  double dark = 0.0;
  double bright = bright_limit;
  double alpha = 0.5 * bright_limit;
  for (int round = 0; round < 200 && bright - dark > 4e-16 * bright; ++round) {
    const Dual<double> angle(alpha, 1.0, 0.0);
    Dual<double> sine;
    Dual<double> cosine;
    sine_cosine(angle, sine, cosine);
    const RayStart<Dual<double>> ray = start_ray(camera, chart_direction(chart, cosine, sine, gamma));
    const Dual<double> value = darkness(camera.spin, camera.horizon_r, ray);
    (value.value < 0.0 ? bright : dark) = alpha;
    const double newton = alpha - value.value / value.along_x;
    const bool inside = newton > dark && newton < bright;
    if (inside && ::fabs(newton - alpha) <= 1e-15 * alpha) {
      return newton;
    }
    // Every third round bisects, so the bracket shrinks for any curve.
    alpha = inside && round % 3 != 2 ? newton : 0.5 * (dark + bright);
  }
  return alpha;
}

//! Returns the edge at a position angle like edge_polar_angle(), from a guess: an edge nearby. `exact`
//! receives false if Newton's method does not converge in a few rounds; the result is then useless.
ERGO_HD double edge_near_guess(const CameraStation& camera, const ShadowChart& chart, double gamma, double guess,
                               bool& exact) {
  constexpr double pi_rad = 3.14159265358979323846;
  // Newton's method squares the error of this step, relative to the edge's angle.
  constexpr double last_step = 1e-9;
  double alpha = guess;
  for (int round = 0; round < 5; ++round) {
    Dual<double> sine;
    Dual<double> cosine;
    sine_cosine(Dual<double>(alpha, 1.0, 0.0), sine, cosine);
    const RayStart<Dual<double>> ray = start_ray(camera, chart_direction(chart, cosine, sine, gamma));
    const Dual<double> value = darkness(camera.spin, camera.horizon_r, ray);
    const double newton = alpha - value.value / value.along_x;
    if (!(newton > 0.0 && newton < pi_rad)) {
      break;
    }
    if (::fabs(newton - alpha) <= last_step * alpha) {
      exact = true;
      return newton;
    }
    alpha = newton;
  }
  exact = false;
  return alpha;
}

namespace detail {
//! Returns a chart about `centre` whose position angle 0 points along +φ, or along +θ if `centre`
//! is almost at ±φ.
ERGO_HD ShadowChart chart_about(const Vector3<double>& centre) {
  const Vector3<double> e_phi = {0.0, 0.0, 1.0};
  const Vector3<double> e_theta = {0.0, 1.0, 0.0};
  const Vector3<double> axis = ::fabs(centre.z) < 0.999 ? e_phi : e_theta;
  const Vector3<double> first = normalized(axis - dot(axis, centre) * centre);
  return {centre, first, cross(centre, first)};
}

ERGO_HD Vector3<double> onto_equator(const Vector3<double>& n) {
  const Vector3<double> flat = {n.x, 0.0, n.z};
  return dot(flat, flat) > 0.0 ? normalized(flat) : n;
}
}  // namespace detail

//! Chooses the chart of a camera's shadow: about the middle of the dark arc that runs through the
//! shadow along ±φ.
//!
//! The ingoing principal null ray always meets the hole and the outgoing one always comes from the
//! sky (K = 0 for both, so there is no barrier). So the arc starts at the ingoing ray. If the
//! opposite direction is dark too (close to the horizon, where the bright sky is a small disk), the
//! outgoing ray limits the search. The arc lies in the plane of e_r and e_φ wherever that meets the
//! shadow. If that plane misses the bright disk, the chart is about the direction opposite to the
//! outgoing ray. The far pole of the chart is the middle of the bright arc, so every great circle
//! from the center meets the edge.
ERGO_HD ShadowChart make_shadow_chart(const CameraStation& camera) {
  const Vector3<double> in = detail::principal_direction(camera, -1.0);
  const Vector3<double> flat = detail::onto_equator(in);
  const Vector3<double> start = direction_is_bright(camera, flat) ? in : flat;
  const ShadowChart arc = detail::chart_about(start);
  double forward_limit = pi;
  double backward_limit = pi;
  if (!direction_is_bright(camera, -start)) {
    const Vector3<double> out = detail::principal_direction(camera, 1.0);
    const double angle = ::atan2(dot(out, arc.first), dot(out, arc.centre));
    forward_limit = angle > 0.0 ? angle : angle + 2.0 * pi;
    backward_limit = 2.0 * pi - forward_limit;
    if (!direction_is_bright(camera, chart_direction<double>(arc, ::cos(angle), ::sin(angle), 0.0))) {
      return detail::chart_about(-out);
    }
  }
  const double middle =
      0.5 * (edge_along_circle(camera, arc, 0.0, forward_limit) - edge_along_circle(camera, arc, pi, backward_limit));
  return detail::chart_about(normalized(chart_direction<double>(arc, ::cos(middle), ::sin(middle), 0.0)));
}

//! Returns the polar angle of the shadow's edge about the chart's center at a position angle [rad]:
//! the critical curve.
//!
//! Accurate for all |a| <= 1, including a = 0 (nothing divides by the spin), between the photon
//! orbits and in the ergosphere.
ERGO_HD double edge_polar_angle(const CameraStation& camera, const ShadowChart& chart, double gamma) {
  return edge_along_circle(camera, chart, gamma, 3.14159265358979323846);
}

//! Returns the signed angle of a direction from the shadow's edge [rad]: positive outside, along
//! the great circle through the center.
ERGO_HD double edge_distance(const CameraStation& camera, const ShadowChart& chart, const Vector3<double>& n) {
  return chart_polar_angle(chart, n) - edge_polar_angle(camera, chart, chart_position_angle(chart, n));
}

}  // namespace ergodome::inline ERGO_TARGET
