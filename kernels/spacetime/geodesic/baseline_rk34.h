#pragma once

#include "kernels/spacetime/geodesic/integration.h"

// The method of the published tracer, for comparison only: polar angles θ and φ with sinθ in a
// denominator, its own pair of Runge-Kutta weights and its own step control. Generalized from
// Schwarzschild to Kerr, in Mino time, so that only the coordinates of the polar motion, the pair
// and the step control differ from the other integrators.
namespace ergodome::inline ERGO_TARGET {

template <class T>
struct AngularState {
  T u, u_rate, theta, theta_rate, phi;
};

namespace detail {

template <class T>
ERGO_HD AngularState<T> angular_rate(ScalarOf<T> spin, const RayStart<T>& ray, const AngularState<T>& s) {
  using S = ScalarOf<T>;
  const S a2 = spin * spin;
  const T l = ray.axial_angular_momentum;
  const T carter = ray.polar_constant - l * l;
  T sine;
  T cosine;
  sine_cosine(s.theta, sine, cosine);
  const T u2 = s.u * s.u;
  const T force = (a2 - ray.polar_constant) + S(3) * ray.shear_constant * s.u - S(2) * a2 * carter * u2;
  const T lapse = S(1) - S(2) * s.u + a2 * u2;
  const T tangent = sine / cosine;
  // Backwards: θ'' = cosθ (L² / sin³θ - a² sinθ),
  // φ' = -(L / sin²θ + (2 a u - a² L u²) / (1 - 2u + a² u²)).
  const T theta_force = l * l / (sine * sine * tangent) - a2 * sine * cosine;
  const T phi_rate = -(l / (sine * sine)) + (a2 * l * u2 - S(2) * spin * s.u) / lapse;
  return {s.u_rate, force * s.u, s.theta_rate, theta_force, phi_rate};
}

template <class T>
ERGO_HD AngularState<T> angular_sum(const AngularState<T>& s, const T& f, const AngularState<T>& d) {
  return {s.u + f * d.u, s.u_rate + f * d.u_rate, s.theta + f * d.theta, s.theta_rate + f * d.theta_rate,
          s.phi + f * d.phi};
}

template <class T>
ERGO_HD AngularState<T> angular_choice(const MaskOf<T>& mask, const AngularState<T>& yes, const AngularState<T>& no) {
  return {select(mask, yes.u, no.u), select(mask, yes.u_rate, no.u_rate), select(mask, yes.theta, no.theta),
          select(mask, yes.theta_rate, no.theta_rate), select(mask, yes.phi, no.phi)};
}

//! Returns the initial state of a ray, in angles.
template <class T>
ERGO_HD AngularState<T> baseline_start(const RayStart<T>& start) {
  using S = ScalarOf<T>;
  T camera_theta(S(0));
  for (int i = 0; i < RealTraits<T>::lane_count; ++i) {
    set_lane(camera_theta, i,
             static_cast<S>(::atan2(static_cast<double>(lane(start.m.x, i)), static_cast<double>(lane(start.m.z, i)))));
  }
  const T theta_rate = start.m.z * start.m_rate.x - start.m.x * start.m_rate.z;
  return {start.u, start.u_rate, camera_theta, theta_rate, T(S(0))};
}

template <class T>
struct BaselineTrial {
  AngularState<T> end;
  T estimate;
};

//! Takes one step by the published tracer's pair of Runge-Kutta formulas.
template <class T>
ERGO_HD BaselineTrial<T> try_baseline_step(ScalarOf<T> spin, const RayStart<T>& start, const AngularState<T>& y,
                                           const T& h) {
  using S = ScalarOf<T>;
  const AngularState<T> a = angular_rate(spin, start, y);
  const AngularState<T> b = angular_rate(spin, start, angular_sum(y, S(0.5) * h, a));
  const AngularState<T> c = angular_rate(spin, start, angular_sum(y, S(0.5) * h, b));
  const AngularState<T> d = angular_rate(spin, start, angular_sum(y, h, c));
  const T sixth = h * S(1.0 / 6);
  AngularState<T> end = angular_sum(y, sixth, a);
  end = angular_sum(end, S(2) * sixth, b);
  end = angular_sum(end, S(2) * sixth, c);
  end = angular_sum(end, sixth, d);
  // The published estimate: (a + 2b + 3c) / 6 against (a + 2b + 2c + d) / 6.
  const AngularState<T> e = {sixth * (c.u - d.u), sixth * (c.u_rate - d.u_rate), sixth * (c.theta - d.theta),
                             sixth * (c.theta_rate - d.theta_rate), sixth * (c.phi - d.phi)};
  return {end, sqrt(e.u * e.u + e.u_rate * e.u_rate + e.theta * e.theta + e.theta_rate * e.theta_rate + e.phi * e.phi)};
}

}  // namespace detail

//! Follows a ray by the baseline method. Arguments as for trace_taylor() (taylor.h). A camera on
//! the spin axis, where its angles do not exist, gives rays that do not converge or are wrong; the
//! comparison is meant to show this.
template <class T>
ERGO_HD RayEnd<T> trace_baseline_rk34(ScalarOf<T> spin, const RayStart<T>& start, const MaskOf<T>& active_at_start,
                                      const IntegrationSettings& settings, T& steps, MaskOf<T>& reached) {
  using S = ScalarOf<T>;
  using detail::angular_rate;
  using detail::angular_sum;
  const T zero(S(0));
  AngularState<T> y = detail::baseline_start(start);
  const T polar_speed = safe_sqrt(maximum(start.polar_constant, zero)) + S(1);
  const T longest = S(0.5) / polar_speed;
  const T tolerance(static_cast<S>(settings.tolerance));
  T h = S(0.01) / polar_speed;
  T time = zero;
  T error = zero;
  steps = zero;
  // Rays to a camera inside the horizon are not traced: the Boyer-Lindquist azimuth of their light
  // diverges where it enters.
  const S horizon_r = kerr_horizon_radius(spin);
  const MaskOf<T> begun = active_at_start & (horizon_r * start.u < T(S(1)));
  auto active = begun;
  for (int step = 0; step < settings.step_limit && any(active); ++step) {
    const detail::BaselineTrial<T> trial = detail::try_baseline_step(spin, start, y, h);
    const AngularState<T>& end = trial.end;
    const T estimate = trial.estimate;
    const T wished = h * sqrt(tolerance / (estimate + std::numeric_limits<S>::min()));
    const auto accepted = active & (wished >= S(0.5) * h);
    y = detail::angular_choice(accepted, end, y);
    time = select(accepted, time + h, time);
    error = select(accepted, error + estimate, error);
    steps = select(active, steps + S(1), steps);
    h = minimum(wished, longest);
    active = active & (!(accepted & (y.u <= zero)));
  }
  reached = begun & (!active);
  // The last step went past infinity: go back to u = 0 along a straight line.
  const T rest = -(y.u / y.u_rate);
  y = angular_sum(y, rest, angular_rate(spin, start, y));
  T sine;
  T cosine;
  T phi_sine;
  T phi_cosine;
  sine_cosine(y.theta, sine, cosine);
  sine_cosine(y.phi, phi_sine, phi_cosine);
  const Vector3<T> sky = {sine * phi_cosine, sine * phi_sine, cosine};
  reached = reached & (dot(sky, sky) < T(S(2)));
  return {sky, time + rest, error};
}

}  // namespace ergodome::inline ERGO_TARGET
