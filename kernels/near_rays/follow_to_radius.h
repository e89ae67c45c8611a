#pragma once

#include "kernels/near_rays/way_through_shells.h"
#include "kernels/spacetime/geodesic/baseline_rk34.h"
#include "kernels/spacetime/geodesic/runge_kutta.h"
#include "kernels/spacetime/geodesic/taylor.h"

// The integrators of spacetime/geodesic, each with its own steps. They follow a ray to the radius
// where it ends, not to the sky.
namespace ergodome::inline ERGO_TARGET {

//! Cost and accuracy of following a ray.
template <class T>
struct FollowedRay {
  T steps;
  T error;            //!< the integrator's estimate [rad]
  MaskOf<T> arrived;  //!< lanes that ended within the step limit
};

//! Follows rays by Taylor series, like trace_taylor().
template <int Order, class T>
ERGO_HD FollowedRay<T> follow_taylor(ScalarOf<T> spin, const RayStart<T>& start, const WayEnd<T>& end,
                                     const MaskOf<T>& wanted, const IntegrationSettings& settings) {
  using S = ScalarOf<T>;
  const T tolerance = local_tolerance(spin, start, settings);
  const T polar_speed = safe_sqrt(maximum(start.polar_constant, T(S(0)))) + S(1);
  const T longest(S(3));
  const T inverse_scale = S(1) / polar_speed;
  const TaylorCoefficients<T> coefficients = taylor_coefficients(spin, start, inverse_scale);
  RayState<T> state = initial_state(start);
  state.u_rate = state.u_rate * inverse_scale;
  state.m_rate = {state.m_rate.x * inverse_scale, state.m_rate.y * inverse_scale, state.m_rate.z * inverse_scale};
  T error(S(0));
  T steps(S(0));
  auto active = wanted;
  TaylorSeries<Order, T> series;
  for (int step = 0; step < settings.step_limit && any(active); ++step) {
    expand(spin, coefficients, state, series);
    const T length = minimum(longest, detail::step_length(series, tolerance, polar_speed));
    detail::assign_where<T>(active, state, evaluate(series, length));
    error = select(active, error + tolerance * S(0.25), error);
    steps = select(active, steps + S(1), steps);
    active = active & (!has_passed(end, state.u, state.u_rate));
  }
  const MaskOf<T> arrived = wanted & (!active);
  return {steps, error, arrived};
}

//! Follows rays by an embedded Runge-Kutta pair, like trace_runge_kutta().
template <class Tableau, class T>
ERGO_HD FollowedRay<T> follow_runge_kutta(ScalarOf<T> spin, const RayStart<T>& start, const WayEnd<T>& end,
                                          const MaskOf<T>& wanted, const IntegrationSettings& settings) {
  using S = ScalarOf<T>;
  const T zero(S(0));
  const T polar_speed = safe_sqrt(maximum(start.polar_constant, zero)) + S(1);
  const T allowed = maximum(local_tolerance(spin, start, settings), T(S(4) * std::numeric_limits<S>::epsilon()));
  const T longest = S(0.5) / polar_speed;
  const S exponent = S(1.0 / (Tableau::error_order + 1));
  RayState<T> state = initial_state(start);
  RayState<T> stage[Tableau::stages];
  T h = S(0.05) / polar_speed;
  T error = zero;
  T steps = zero;
  auto active = wanted;
  for (int step = 0; step < settings.step_limit && any(active); ++step) {
    stage[0] = rate_of(spin, start, state);
    const detail::Trial<T> trial = detail::try_step<Tableau>(spin, start, state, h, polar_speed, stage);
    const auto accepted = active & (trial.error <= allowed);
    state = detail::chosen(accepted, trial.end, state);
    error = select(accepted, error + trial.error, error);
    steps = select(active, steps + S(1), steps);
    const T wished = rough_power(allowed / (trial.error + std::numeric_limits<S>::min()), exponent) * S(0.85);
    h = minimum(h * minimum(maximum(wished, T(S(0.2))), T(S(4))), longest);
    active = active & (!(accepted & has_passed(end, state.u, state.u_rate)));
  }
  const MaskOf<T> arrived = wanted & (!active);
  return {steps, error, arrived};
}

//! Follows rays by the published tracer's method, like trace_baseline_rk34().
template <class T>
ERGO_HD FollowedRay<T> follow_baseline(ScalarOf<T> spin, const RayStart<T>& start, const WayEnd<T>& end,
                                       const MaskOf<T>& wanted, const IntegrationSettings& settings) {
  using S = ScalarOf<T>;
  const T zero(S(0));
  AngularState<T> state = detail::baseline_start(start);
  const T polar_speed = safe_sqrt(maximum(start.polar_constant, zero)) + S(1);
  const T longest = S(0.5) / polar_speed;
  const T tolerance(static_cast<S>(settings.tolerance));
  T h = S(0.01) / polar_speed;
  T error = zero;
  T steps = zero;
  auto active = wanted;
  for (int step = 0; step < settings.step_limit && any(active); ++step) {
    const detail::BaselineTrial<T> trial = detail::try_baseline_step(spin, start, state, h);
    const T wished = h * sqrt(tolerance / (trial.estimate + std::numeric_limits<S>::min()));
    const auto accepted = active & (wished >= S(0.5) * h);
    state = detail::angular_choice(accepted, trial.end, state);
    error = select(accepted, error + trial.estimate, error);
    steps = select(active, steps + S(1), steps);
    h = minimum(wished, longest);
    active = active & (!(accepted & has_passed(end, state.u, state.u_rate)));
  }
  const MaskOf<T> arrived = wanted & (!active);
  return {steps, error, arrived};
}

}  // namespace ergodome::inline ERGO_TARGET
