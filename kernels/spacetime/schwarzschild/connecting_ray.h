#pragma once

#include "kernels/core/angles.h"
#include "kernels/core/find_root.h"
#include "kernels/spacetime/schwarzschild/null_orbit.h"

// The light ray between two points in Schwarzschild spacetime. Outside the horizon, light paths are
// geodesics of the optical metric, and travel time is their length. This metric is complete, and
// negatively curved outside r = 3/2. So for each winding number there is exactly one ray between
// two points (Cartan and Hadamard): azimuth 0 to π is order 1, π to 2π, around the other side,
// order 2, and so on.
namespace ergodome::inline ERGO_TARGET {

//! A light ray from a point to an observer, in the plane of a Schwarzschild hole; M = 1.
struct ConnectingRay {
  //! Angle at a static observer between the apparent direction of the point and outward [rad].
  double xi;
  double travel_time;  //!< coordinate time from the point to the observer [M]
  //! Affine distance along the ray, for a photon of energy 1 at infinity [M]. Divide by √(1 -
  //! 2/r_obs) for a photon that an observer at rest sees with energy 1.
  double affine_distance;
  double impact_parameter;  //!< b: angular momentum over energy [M]
  //! Angle at a static emitter at the point between the direction of emission and outward [rad].
  double emission_angle;
  //! Rate du/dφ at the observer [1/M]; u = 1/r, φ increases from observer to point.
  double rate_at_observer;
  double rate_at_point;  //!< du/dφ at the point [1/M], with the same direction of φ
};

namespace detail {

//! The two points, in the quantities that the orbits need.
struct Endpoints {
  double r_far, r_near;  //!< radii of both points; far: the larger one [M]
  double u_far, u_near;  //!< u = 1/r of both points [1/M]
  double v_far, v_near;  //!< v = u - 1/3 of both points
  double gap;            //!< u_near - u_far
  double log_gap;        //!< r*_far - r*_near [M]; r*: tortoise coordinate (null_orbit.h)
  double r_gap;          //!< r_far - r_near [M]
  bool observer_is_near;
};

ERGO_HD Endpoints make_endpoints(double r_observer, double r) {
  Endpoints ends{};
  ends.observer_is_near = r_observer < r;
  ends.r_near = ::fmin(r_observer, r);
  ends.r_far = ::fmax(r_observer, r);
  ends.u_near = 1.0 / ends.r_near;
  ends.u_far = 1.0 / ends.r_far;
  ends.v_near = (3.0 - ends.r_near) * ends.u_near / 3.0;
  ends.v_far = (3.0 - ends.r_far) * ends.u_far / 3.0;
  const double apart = ends.r_far - ends.r_near;
  ends.gap = apart * ends.u_near * ends.u_far;
  ends.r_gap = apart;
  ends.log_gap = apart + 2.0 * ::log1p(apart / (ends.r_near - 2.0));
  return ends;
}

//! Returns √(1 - 2/r).
ERGO_HD double lapse(double r) { return ::sqrt((r - 2.0) / r); }

//! Orbits that turn beyond two points on the same side of the photon sphere, with one parameter z
//! that grows with the azimuth. For z < 0 the points are on one leg. For z = 0 the orbit turns at
//! the point that is nearer to the photon sphere, the pivot. For z > 0 the turn is between the
//! points.
struct TurningFamily {
  double u_pivot;             //!< u of the pivot
  double from_photon_sphere;  //!< |u - 1/3| of the pivot
  double from_half;           //!< 1/2 - u of the pivot
  double side;                //!< +1: turns below u = 1/3, outside the photon sphere; -1: above
  double gap;

  //! Returns the distance of the pivot from the turn: |u - 1/3| of the turn is that of the pivot
  //! times e^(-z²).
  ERGO_HD double pivot_distance(double z) const { return -from_photon_sphere * ::expm1(-z * z); }

  ERGO_HD TurningOrbit orbit(double z) const {
    const double beyond = side * pivot_distance(z);
    return turning_orbit(u_pivot + beyond, from_photon_sphere * ::exp(-z * z), from_half - beyond, side);
  }

  ERGO_HD double swept(double z) const {
    const TurningOrbit o = orbit(z);
    const double near_turn = pivot_distance(z);
    const double short_leg = swept_angle(o, near_turn);
    return swept_angle(o, near_turn + gap) + (z > 0.0 ? short_leg : -short_leg);
  }
};

struct TurningMismatch {
  TurningFamily family;
  double angle;
  ERGO_HD double operator()(double z) const { return family.swept(z) - angle; }
};

//! Logarithm of wanted over actual azimuth of an orbit that never turns, as a function of y = ln(g
//! - 1/6) (for g see null_orbit.h). The azimuth decreases with y.
struct PlungingMismatch {
  Endpoints ends;
  double angle;
  ERGO_HD double operator()(double y) const {
    const double swept = swept_angle(plunging_orbit(::exp(y)), ends.v_far, ends.v_near, ends.gap);
    return ::log(angle / swept);
  }
};

//! Travel time and affine distance of a ray [M].
struct RayLength {
  double time;
  double affine_distance;
};

//! Builds the ray in terms of observer and point, from |du/dφ| at the far and the near point and
//! the length. If it `turns` between them, `turn_side` is 1 for a turn at the smallest radius, -1
//! for one at the largest.
ERGO_HD ConnectingRay ray_of(const Endpoints& ends, double inverse_b, double rate_far, double rate_near, bool turns,
                             double turn_side, const RayLength& length) {
  // `start` and `end` are du/dφ at the far and the near point, on the way from far to near: inwards
  // all the way, or away from the turn at the end.
  const double start = turns ? turn_side * rate_far : rate_far;
  const double end = turns ? -turn_side * rate_near : rate_near;
  ConnectingRay ray{};
  ray.impact_parameter = 1.0 / inverse_b;
  ray.travel_time = length.time;
  ray.affine_distance = length.affine_distance;
  ray.rate_at_observer = ends.observer_is_near ? -end : start;
  ray.rate_at_point = ends.observer_is_near ? -start : end;
  const double at_far = ::atan2(ends.u_far * lapse(ends.r_far), -start);
  const double at_near = ::atan2(ends.u_near * lapse(ends.r_near), end);
  ray.xi = ends.observer_is_near ? at_near : at_far;
  ray.emission_angle = ends.observer_is_near ? at_far : at_near;
  return ray;
}

//! Returns a ray so close to radial that its bending is below rounding: u is linear in φ.
ERGO_HD ConnectingRay radial_ray(const Endpoints& ends, double angle) {
  const double b = angle / ends.gap;
  ConnectingRay ray{};
  ray.impact_parameter = b;
  ray.travel_time = ends.log_gap + 0.5 * b * angle;
  ray.affine_distance = ends.r_gap + 0.5 * b * angle * (1.0 - ends.u_near - ends.u_far);
  const double at_far = pi - ::asin(b * ends.u_far * lapse(ends.r_far));
  const double at_near = ::asin(b * ends.u_near * lapse(ends.r_near));
  ray.xi = ends.observer_is_near ? at_near : at_far;
  ray.emission_angle = ends.observer_is_near ? at_far : at_near;
  ray.rate_at_observer = ends.observer_is_near ? -1.0 / b : 1.0 / b;
  ray.rate_at_point = ray.rate_at_observer;
  return ray;
}

ERGO_HD ConnectingRay plunging_ray(const Endpoints& ends, double angle) {
  // P >= 1/b² - 1/27 bounds b from below. Towards the critical orbit the azimuth grows at least as
  // -½ ln(g - 1/6).
  const double rate = ends.gap / angle;
  const PlungingMismatch mismatch{ends, angle};
  double high = ::log(::cbrt(0.5 * (rate * rate + 1.0 / 27.0)) + 1e-3);
  double low = high - 2.0;
  for (double step = 3.0; low > -2.0 * angle - 80.0 && mismatch(low) > 0.0; step *= 1.5) {
    high = low;
    low -= step;
  }
  const double y = find_root(low, high, mismatch);
  const PlungingOrbit orbit = plunging_orbit(::exp(y));
  const OrbitLeg leg = plunging_leg(orbit, ends.v_far, ends.v_near, ends.gap);
  return ray_of(ends, ::sqrt(orbit.inverse_b_squared), radial_rate(orbit, ends.v_far), radial_rate(orbit, ends.v_near),
                false, 0.0, {ends.log_gap + leg.delay, ends.r_gap + leg.stretch});
}

ERGO_HD ConnectingRay turning_ray(const Endpoints& ends, const TurningFamily& family, double angle) {
  constexpr double critical = 6.2;  // e^(-z²) is below rounding
  const TurningMismatch mismatch{family, angle};
  double low = -critical;
  double high = 1.0;
  for (int round = 0; round < 40 && mismatch(high) < 0.0; ++round) {
    low = high;
    high *= 1.5;
  }
  const double z = find_root(low, high, mismatch);
  const TurningOrbit orbit = family.orbit(z);
  const double distance = family.pivot_distance(z);
  const OrbitLeg whole = leg_from_turn(orbit, distance + family.gap);
  const OrbitLeg rest = leg_from_turn(orbit, distance);
  const double rate_pivot = radial_rate(orbit, distance);
  const double rate_other = radial_rate(orbit, distance + family.gap);
  RayLength length{ends.log_gap + whole.delay - rest.delay, ends.r_gap + whole.stretch - rest.stretch};
  if (z > 0.0) {
    // Both legs: log_gap covers the part beyond the pivot; the part from pivot to turn counts
    // twice.
    const double r_pivot = 1.0 / family.u_pivot;
    const double r_turn = 1.0 / orbit.turn;
    const double above = 2.0 * family.from_half * r_pivot;  // r - 2
    const double above_turn = 2.0 * (family.from_half - family.side * distance) * r_turn;
    const double out = distance * r_pivot * r_turn;
    length.time = ends.log_gap + 2.0 * (out + 2.0 * ::log1p(out / (family.side > 0.0 ? above_turn : above))) +
                  whole.delay + rest.delay;
    length.affine_distance = ends.r_gap + 2.0 * out + whole.stretch + rest.stretch;
  }
  const bool pivot_is_near = family.side > 0.0;
  return ray_of(ends, ::sqrt(orbit.inverse_b_squared), pivot_is_near ? rate_other : rate_pivot,
                pivot_is_near ? rate_pivot : rate_other, z > 0.0, family.side, length);
}

//! Returns the azimuth between two points on one side of the photon sphere along the critical
//! orbit: with f² = 2u + 1/3, dφ = 2 df / (1 - f²).
ERGO_HD double critical_angle(const Endpoints& ends) {
  const double near = 1.0 + ::sqrt(2.0 * ends.u_near + 1.0 / 3.0);
  const double far = 1.0 + ::sqrt(2.0 * ends.u_far + 1.0 / 3.0);
  return ::fabs(::log(near * near / (far * far) * ends.v_far / ends.v_near));
}

}  // namespace detail

//! Returns why connecting_ray() does not accept the arguments, or nullptr if it does. It rejects
//! radii not above 2 M or above 1e12 M, angles below 0 or above 600 rad, and equal positions.
inline const char* why_not_connected(double r_observer, double r, double angle) {
  if (!(r_observer > 2.0 && r > 2.0)) {
    return "no light escapes from the horizon or from inside it";
  }
  if (!(r_observer <= 1e12 && r <= 1e12)) {
    return "radii may be at most 1e12";
  }
  if (!(angle >= 0.0 && angle <= 600.0)) {
    return "angles must be from 0 to 600 rad";
  }
  return r_observer == r && angle == 0.0 ? "the point is at the observer's position" : nullptr;
}

//! Computes the ray from (r, φ = angle) to an observer at (r_observer, 0) that sweeps the azimuth
//! `angle` about the hole [M, rad]. See why_not_connected() for valid arguments. Image orders are
//! half turns: order n sweeps from (n - 1) π to n π (see image_angle()).
//!
//! The impact parameter is a bracketed root of the azimuth in closed form. It is accurate to
//! relative precision for radial rays, at the turn, at the photon sphere, near the critical orbit,
//! near the horizon and far away.
ERGO_HD_CALLED ConnectingRay connecting_ray(double r_observer, double r, double angle) {
  const detail::Endpoints ends = detail::make_endpoints(r_observer, r);
  if (angle <= 1e-9 * ends.gap / ends.u_near) {
    return detail::radial_ray(ends, angle);
  }
  const bool outside = ends.r_near > 3.0;
  const double r_pivot = outside ? ends.r_near : ends.r_far;
  if (ends.gap == 0.0 && r == 3.0) {
    // Both points are on the photon sphere, on which the light moves along a circle.
    const double b = ::sqrt(27.0);
    return detail::ray_of(ends, 1.0 / b, 0.0, 0.0, false, 0.0, {b * angle, 9.0 / b * angle});
  }
  const bool same_side = outside || ends.r_far < 3.0;
  if (!same_side || angle <= detail::critical_angle(ends)) {
    return detail::plunging_ray(ends, angle);
  }
  const double u_pivot = 1.0 / r_pivot;
  const detail::TurningFamily family{u_pivot, ::fabs(outside ? ends.v_near : ends.v_far),
                                     0.5 * (r_pivot - 2.0) * u_pivot, outside ? 1.0 : -1.0, ends.gap};
  return detail::turning_ray(ends, family, angle);
}

//! Returns the azimuth that the ray of the n-th image (n >= 1) sweeps to a point at azimuth φ in
//! [0, 2π]. A φ that already is such an azimuth is returned unchanged.
ERGO_HD double image_angle(double phi, int order) {
  if (phi >= (order - 1) * pi && phi <= order * pi) {
    return phi;
  }
  const double from_axis = ::fabs(::remainder(phi, 2.0 * pi));
  return order % 2 == 1 ? (order - 1) * pi + from_axis : order * pi - from_axis;
}

}  // namespace ergodome::inline ERGO_TARGET
