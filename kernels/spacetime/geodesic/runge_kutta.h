#pragma once

#include "kernels/spacetime/geodesic/integration.h"
#include "kernels/spacetime/geodesic/tableau.h"

// Null geodesics by embedded Runge-Kutta pairs.
namespace ergodome::inline ERGO_TARGET {

//! Returns the rate of frame dragging, backwards: ψ' = -(2 a u - a² L u²) / (1 - 2u + a² u²) in the
//! Boyer-Lindquist azimuth.
//!
//! For light that moves only inwards (RayStart::ingoing) the azimuth is that of ingoing Kerr
//! coordinates, dφ + (a/Δ) dr. Such light has dr/dλ = -√R, and with X = r² + a² - a L
//!   ψ' = -a [(X - √R) / Δ - 1] = a - a K / (X + √R).
//! Nothing is singular at the horizon, where X = √R > 0 for all light that comes through it. As u
//! falls all the way, √R u² = -u'.
template <class T>
ERGO_HD T drag_rate(ScalarOf<T> spin, const RayStart<T>& ray, const RayState<T>& s) {
  using S = ScalarOf<T>;
  const S a2 = spin * spin;
  const T u2 = s.u * s.u;
  // 1 - 2u + a² u² loses all digits next to the horizon, so it is computed as the product of its
  // factors.
  const S horizon_r = kerr_horizon_radius(spin);
  const T lapse = (S(1) - horizon_r * s.u) * (S(1) - (a2 / horizon_r) * s.u);
  const T outer = (a2 * ray.axial_angular_momentum * u2 - S(2) * spin * s.u) / lapse;
  if (!ray.ingoing) {
    return outer;
  }
  const T sum = S(1) + (a2 - spin * ray.axial_angular_momentum) * u2 - s.u_rate;
  return select(only_comes_in(ray), spin - (spin * ray.shear_constant) * u2 / sum, outer);
}

//! Returns the rate of every component of the state: the equations of motion in Mino time as a
//! first-order system.
//!
//! They are Carter's potentials R(r) and Θ(θ), differentiated once. The radius obeys u'' = u [(a² -
//! C) + 3 K u - 2 a² Q u²]. The polar position obeys m'' = -(C + 2 a² m_z²) m, with a² m_z added to
//! the z component.
template <class T>
ERGO_HD RayState<T> rate_of(ScalarOf<T> spin, const RayStart<T>& ray, const RayState<T>& s) {
  using S = ScalarOf<T>;
  const S a2 = spin * spin;
  const T carter = ray.polar_constant - ray.axial_angular_momentum * ray.axial_angular_momentum;
  const T bend = -(ray.polar_constant + S(2) * a2 * s.m.z * s.m.z);
  const T force = (a2 - ray.polar_constant) + S(3) * ray.shear_constant * s.u - S(2) * a2 * carter * (s.u * s.u);
  return {s.u_rate, force * s.u, s.m_rate, {bend * s.m.x, bend * s.m.y, (bend + a2) * s.m.z}, drag_rate(spin, ray, s)};
}

namespace detail {

template <class T, class Factor>
ERGO_HD RayState<T> added(const RayState<T>& s, const Factor& factor, const RayState<T>& d) {
  return {s.u + factor * d.u, s.u_rate + factor * d.u_rate, s.m + factor * d.m, s.m_rate + factor * d.m_rate,
          s.drag + factor * d.drag};
}

template <class T>
ERGO_HD RayState<T> chosen(const MaskOf<T>& mask, const RayState<T>& yes, const RayState<T>& no) {
  const auto pick = [&](const Vector3<T>& a, const Vector3<T>& b) {
    return Vector3<T>{select(mask, a.x, b.x), select(mask, a.y, b.y), select(mask, a.z, b.z)};
  };
  return {select(mask, yes.u, no.u), select(mask, yes.u_rate, no.u_rate), pick(yes.m, no.m),
          pick(yes.m_rate, no.m_rate), select(mask, yes.drag, no.drag)};
}

//! Converts an error of the state to an error of the sky direction; `polar_speed` converts Mino
//! time to angle.
template <class T>
ERGO_HD T state_size(const RayState<T>& e, const T& polar_speed) {
  const auto sum = [](const Vector3<T>& v) { return absolute(v.x) + absolute(v.y) + absolute(v.z); };
  return sum(e.m) + sum(e.m_rate) / polar_speed + absolute(e.drag) + polar_speed * absolute(e.u) + absolute(e.u_rate);
}

template <class T>
struct Trial {
  RayState<T> end;
  T error;
};

//! Takes one step of a Runge-Kutta pair from `state`, whose rate is stage[0].
template <class Tableau, class T>
ERGO_HD Trial<T> try_step(ScalarOf<T> spin, const RayStart<T>& ray, const RayState<T>& state, const T& h,
                          const T& polar_speed, RayState<T> (&stage)[Tableau::stages]) {
  using S = ScalarOf<T>;
  ERGO_UNROLL
  for (int i = 1; i < Tableau::stages; ++i) {
    RayState<T> at = state;
    ERGO_UNROLL
    for (int j = 0; j < i; ++j) {
      if (Tableau::a(i, j) != 0.0) {
        at = added(at, static_cast<S>(Tableau::a(i, j)) * h, stage[j]);
      }
    }
    stage[i] = rate_of(spin, ray, at);
  }
  const T zero(S(0));
  RayState<T> end = state;
  RayState<T> difference = {zero, zero, {zero, zero, zero}, {zero, zero, zero}, zero};
  ERGO_UNROLL
  for (int i = 0; i < Tableau::stages; ++i) {
    end = added(end, static_cast<S>(Tableau::b(i)) * h, stage[i]);
    difference = added(difference, static_cast<S>(Tableau::b(i) - Tableau::b_embedded(i)) * h, stage[i]);
  }
  return {end, state_size(difference, polar_speed)};
}

}  // namespace detail

//! Follows a ray that is known to come from the sky to its end, with an embedded Runge-Kutta pair.
//! Arguments as for trace_taylor() (taylor.h).
//!
//! The error estimate is that of the lower order, but the solution of the higher order is
//! continued. So the errors of all steps together remain near the tolerance.
template <class Tableau, class T>
ERGO_HD RayEnd<T> trace_runge_kutta(ScalarOf<T> spin, const RayStart<T>& start, const MaskOf<T>& active_at_start,
                                    const IntegrationSettings& settings, T& steps, MaskOf<T>& reached) {
  using S = ScalarOf<T>;
  const T zero(S(0));
  const T one(S(1));
  const T polar_speed = safe_sqrt(maximum(start.polar_constant, zero)) + S(1);
  const T tolerance = local_tolerance(spin, start, settings);
  const T rounding(S(4) * std::numeric_limits<S>::epsilon());
  const T longest = S(0.5) / polar_speed;
  const S exponent = S(1.0 / (Tableau::error_order + 1));
  const S horizon_r = kerr_horizon_radius(spin);
  const T min_way(std::numeric_limits<S>::epsilon());
  RayState<T> state = initial_state(start);
  RayState<T> stage[Tableau::stages];
  stage[0] = rate_of(spin, start, state);
  T h = S(0.05) / polar_speed;
  T time = zero;
  T error = zero;
  steps = zero;
  auto active = active_at_start;
  for (int step = 0; step < settings.step_limit && any(active); ++step) {
    // Frame dragging diverges at the horizon. An estimate that leaves out the first stage (as the
    // third-order pair's does) misses how fast the drag changes for light that starts there. So a
    // step covers at most half of the distance to the horizon.
    const T way = maximum(S(1) - horizon_r * state.u, min_way) / (absolute(state.u_rate) + min_way);
    const T near = minimum(h, S(0.5) * way);
    h = start.ingoing ? select(only_comes_in(start), h, near) : near;
    const detail::Trial<T> trial = detail::try_step<Tableau>(spin, start, state, h, polar_speed, stage);
    const T allowed = maximum(tolerance, rounding);
    const auto accurate = trial.error <= allowed;
    // The step went past infinity: go back to u = 0 by Newton's method on the step length.
    const auto beyond = trial.end.u < zero;
    const T miss = trial.end.u / trial.end.u_rate;
    const T miss_angle = miss * polar_speed;
    const auto close = miss_angle * miss_angle < S(0.01) * maximum(tolerance, rounding);
    const auto finished = active & accurate & close & (trial.end.u_rate < zero);
    const auto accepted = active & accurate & ((!beyond) | finished);
    state = detail::chosen(accepted, trial.end, state);
    time = select(accepted, time + h, time);
    error = select(accepted, error + trial.error, error);
    steps = select(active, steps + one, steps);
    if constexpr (Tableau::first_same_as_last) {
      stage[0] = detail::chosen(accepted, stage[Tableau::stages - 1], stage[0]);
    } else {
      stage[0] = rate_of(spin, start, state);
    }
    const T wished = rough_power(allowed / (trial.error + std::numeric_limits<S>::min()), exponent) * S(0.85);
    const T regulated = h * minimum(maximum(wished, T(S(0.2))), T(S(4)));
    const T back = h - miss;
    const auto can_go_back = (back > zero) & (back < h);
    const T shorter = select(can_go_back, back, S(0.5) * h);
    h = minimum(select(accurate & beyond, shorter, regulated), longest);
    active = active & (!finished);
  }
  reached = active_at_start & (!active);
  // The remainder up to u = 0 is so short that a straight line is exact.
  const T rest = -(state.u / state.u_rate);
  state = detail::added(state, rest, rate_of(spin, start, state));
  const Vector3<T> sky = sky_direction(state);
  const T square = dot(sky, sky);
  reached = reached & (square < T(S(2)));
  // The sky direction is normalized, because in float the errors of many steps around the hole
  // change the length of the vector by about 1e-5.
  return {(S(1) / sqrt(select(reached, square, one))) * sky, time + rest, error};
}

}  // namespace ergodome::inline ERGO_TARGET
