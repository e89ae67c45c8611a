#pragma once

#include "kernels/core/dual.h"
#include "kernels/near_rays/radial_fate.h"
#include "kernels/near_rays/series_search.h"

// Steps of a ray's path as Taylor series, and the loop that follows rays past objects.
namespace ergodome {

//! Range of radii that contains all objects [M].
struct RadialBounds {
  double minimum;  //!< minimum radius; it is outside the horizon
  double maximum;
};

//! Limits for following rays past objects: precision, number of steps, and the delay at their
//! start.
struct MeshLimits {
  double tolerance;  //!< maximum local error of a step, as an angle [rad]
  int step_limit;
  double delay = 0.0;  //!< coordinate time that is already counted at the start of the rays [M]
};

inline namespace ERGO_TARGET {

//! A step of one ray's path: its series, in scaled time h from 0 on. T is double, or Dual<double>.
template <int Order, NearParts Parts, class T>
struct PathStep {
  detail::NearSeries<Order, T, Parts> series;
  Vector3<double> axes[2];  //!< directions of m's x and y, before frame dragging
  double min_u;             //!< no objects are farther out: positions are clamped to this 1/r
  double length;            //!< length of the step, in h
  double scale;             //!< time h of the series over Mino time
  //! Mino time at h = 0, from the camera, for a photon seen with energy 1 [1/M].
  double start;
  double delay_at_camera;  //!< coordinate time that is added to all delays [M]

  //! Converts a vector (x, y, z) in the axes of m to pseudo-Cartesian axes: rotates it by `drag`
  //! and by the camera's azimuth.
  ERGO_HD Vector3<T> turned(const T& drag, const T& x, const T& y, const T& z) const {
    T sine;
    T cosine;
    sine_cosine(drag, sine, cosine);
    const T along = cosine * x - sine * y;
    const T across = sine * x + cosine * y;
    return {along * axes[0].x + across * axes[1].x, along * axes[0].y + across * axes[1].y, z};
  }

  //! Returns the pseudo-Cartesian position on the path at time h [M].
  ERGO_HD Vector3<T> point(const T& h) const {
    const auto& s = series;
    const T u = series_value(s.u, h);
    const T r = 1.0 / (value_of(u) > min_u ? u : T(min_u));
    return r * turned(series_value(s.drag, h), series_value(s.x, h), series_value(s.y, h), series_value(s.z, h));
  }

  //! Returns dm/dλ, backwards, in pseudo-Cartesian axes [M]. It is rotated by the frame dragging so
  //! far, but does not include the rate of that rotation.
  ERGO_HD Vector3<T> polar_momentum(const T& h) const {
    const auto& s = series;
    return scale * turned(series_value(s.drag, h), series_rate(s.x, h), series_rate(s.y, h), series_rate(s.z, h));
  }

  //! Returns the affine distance from the camera [M]; only valid if Parts includes the distance.
  ERGO_HD T distance(const T& h) const { return series_value(series.distance, h); }

  //! Returns the coordinate time from the point at h to the camera [M]; 0 if it is not carried.
  ERGO_HD double delay(double h) const {
    if constexpr (has_delay(Parts)) {
      return delay_at_camera + value_of(series_value(series.delay, T(h)));
    } else {
      return 0.0;
    }
  }
};

//! Returns a vector without its derivatives.
ERGO_HD Vector3<double> plain_vector(const Vector3<Dual<double>>& v) { return {v.x.value, v.y.value, v.z.value}; }

namespace detail {

template <class T>
ERGO_HD double one_lane(const T& all, int i) {
  return lane(all, i);
}
template <class T>
ERGO_HD Dual<double> one_lane(const Dual<T>& all, int i) {
  return {lane(all.value, i), lane(all.along_x, i), lane(all.along_y, i)};
}

template <int Count, class T, class One>
ERGO_HD void take_lane(const T (&all)[Count], int i, One (&one)[Count]) {
  for (int k = 0; k < Count; ++k) {
    one[k] = one_lane(all[k], i);
  }
}

//! Copies the series of lane `i`.
template <int Order, NearParts Parts, class T, class One>
ERGO_HD void take_lane(const NearSeries<Order, T, Parts>& all, int i, NearSeries<Order, One, Parts>& one) {
  take_lane(all.u, i, one.u);
  take_lane(all.x, i, one.x);
  take_lane(all.y, i, one.y);
  take_lane(all.z, i, one.z);
  take_lane(all.drag, i, one.drag);
  if constexpr (has_delay(Parts)) {
    take_lane(all.delay, i, one.delay);
  }
  if constexpr (has_distance(Parts)) {
    take_lane(all.distance, i, one.distance);
  }
}

//! Returns the length of a step, which is at most `length`. For light that leaves for good, ends
//! the step slightly beyond the radius to which positions are clamped: no objects are there, and a
//! path with a kink would be cut into many pieces.
template <int Order, NearParts Parts, class T>
ERGO_HD double length_within(const PathStep<Order, Parts, T>& step, double length) {
  const auto is_beyond = [&](double h) { return value_of(series_value(step.series.u, T(h))) < step.min_u; };
  if (!is_beyond(length) || is_beyond(0.0)) {
    return length;
  }
  constexpr int rounds = 8;
  double within = 0.0;
  for (int round = 0; round < rounds; ++round) {
    const double middle = 0.5 * (within + length);
    (is_beyond(middle) ? length : within) = middle;
  }
  return length;
}

//! Shortens the step of lanes that come out through the horizon to where they reach 1/r =
//! `innermost_u`; returns those lanes. Before that there are no objects, and azimuth and time are
//! in ingoing Kerr coordinates.
template <int Order, NearParts Parts, class T>
ERGO_HD MaskOf<RealOf<T>> end_way_out(const NearSeries<Order, T, Parts>& s, const MaskOf<RealOf<T>>& on_way_out,
                                      const RealOf<T>& innermost_u, RealOf<T>& length) {
  using Real = RealOf<T>;
  const MaskOf<Real> arrives = on_way_out & !(value_of(series_value(s.u, length)) > innermost_u);
  if (any(arrives)) {
    Real beyond[Order + 1];
    for (int k = 0; k <= Order; ++k) {
      beyond[k] = value_of(s.u[k]);
    }
    beyond[0] = beyond[0] - innermost_u;
    length = select(arrives, time_to_zero(beyond, Real(1.0), Real(0.0), length), length);
  }
  return arrives;
}

//! The number type of one lane of T.
template <class T>
struct OneLane {
  using Type = double;
};
template <class T>
struct OneLane<Dual<T>> {
  using Type = Dual<double>;
};

}  // namespace detail

//! Follows rays backwards from a camera at azimuth φ, step by step, as long as they may come
//! between the radii, on all ways round the hole. Calls visit(lane, step) for each step that does.
//! `visit` returns whether the lane is finished. Lanes are doubles, or duals of them.
//! `active_at_start`: lanes to follow. Returns false in lanes that reached the step limit before
//! the result was known.
template <int Order, NearParts Parts, class T, class Visit>
ERGO_HD MaskOf<RealOf<T>> follow_path(ScalarOf<T> spin, double cosine_phi, double sine_phi, const NearRay<T>& ray,
                                      const RadialBounds& bounds, const MeshLimits& limits,
                                      const MaskOf<RealOf<T>>& active_at_start, Visit&& visit) {
  static_assert(has_azimuth(Parts) && sizeof(ScalarOf<T>) == 8);
  using Real = RealOf<T>;
  using One = typename detail::OneLane<T>::Type;
  const Real zero(0.0);
  const Real outermost(1.0 / bounds.maximum);
  const Real innermost(1.0 / bounds.minimum);
  const RadialFate<Real> fate = radial_fate(spin, ray);
  const Real scale =
      safe_sqrt(maximum(value_of(ray.polar_constant), zero)) + maximum(absolute(value_of(ray.energy)), Real(1.0));
  const Real inverse_scale = Real(1.0) / scale;
  detail::NearCoefficients<T> coefficients = detail::near_coefficients(spin, ray, inverse_scale);
  detail::NearSeries<Order, T, Parts> s;
  detail::start_series(ray, inverse_scale, s);
  // Azimuth and time must be in Boyer-Lindquist coordinates where objects may be.
  const MaskOf<Real> coming_out = coefficients.ingoing & (value_of(s.u[0]) > innermost);
  detail::count_on_outside(spin, coefficients.ingoing & !coming_out, s);
  coefficients.ingoing = coming_out;
  PathStep<Order, Parts, One> step;
  step.axes[0] = {cosine_phi, sine_phi, 0.0};
  step.axes[1] = {-sine_phi, cosine_phi, 0.0};
  step.delay_at_camera = limits.delay;
  Real time = zero;
  Real u = value_of(s.u[0]);
  const auto goes_by = [&](const Real& rate) {
    return (keeps_inwards(fate, u, rate) & (u >= innermost)) | (keeps_outwards(fate, u, rate) & (u <= outermost));
  };
  MaskOf<Real> active = active_at_start & !goes_by(value_of(s.u[1])) & has_been_outside(spin, ray);
  for (int count = 0; count < limits.step_limit && any(active); ++count) {
    detail::expand_near(spin, ray, coefficients, s);
    Real length = detail::near_step(s, scale, limits.tolerance);
    const MaskOf<Real> on_way_out = coefficients.ingoing;
    const MaskOf<Real> arrives = detail::end_way_out(s, on_way_out, innermost, length);
    const Real end_u = value_of(series_value(s.u, length));
    const Real end_rate = value_of(series_rate(s.u, length));
    // A step that begins and ends outside the outermost objects, without a turning point between,
    // meets none.
    const MaskOf<Real> far_out = (u < outermost) & (end_u < outermost) & (value_of(s.u[1]) * end_rate > zero);
    const unsigned near = mask_bits(active & !(far_out | on_way_out));
    Real found = zero;
    for (int i = 0; i < RealTraits<Real>::lane_count; ++i) {
      if (((near >> static_cast<unsigned>(i)) & 1U) == 0U) {
        continue;
      }
      detail::take_lane(s, i, step.series);
      step.min_u = 0.5 * ::fmin(1.0 / bounds.maximum, lane(value_of(ray.u), i));
      step.length = detail::length_within(step, lane(length, i));
      step.scale = lane(scale, i);
      step.start = lane(time, i);
      if (visit(i, step)) {
        set_lane(found, i, 1.0);
      }
    }
    time = time + length * inverse_scale;
    detail::move_series(s, length);
    detail::count_on_outside(spin, arrives, s);
    coefficients.ingoing = on_way_out & !arrives;
    u = end_u;
    active = active & !goes_by(end_rate) & !(found > zero);
  }
  return !active;
}

}  // namespace ERGO_TARGET
}  // namespace ergodome
