#pragma once

#include <algorithm>
#include <cmath>

#include "kernels/spacetime/geodesic/radial_potential.h"
#include "kernels/spacetime/geodesic/taylor.h"

// Follows a ray step by step, as trace_taylor does, and checks its first integrals (constants of
// motion) at each step.
namespace ergodome::test {

//! Errors of a ray's first integrals at a point, relative to the largest term of each equation. u =
//! 1/r, m is the unit vector of the polar position, and a prime is a derivative in Mino time.
struct IntegralMisses {
  //! Radial equation: u'² = U(u).
  double radial = 0.0;
  //! Polar equation, with Carter's constant C = Q + L²: |m'|² = C + a² m_z².
  double polar = 0.0;
  //! The vector m remains a unit vector: |m|² = 1.
  double unit = 0.0;
  //! Axial angular momentum: (m x m')_z = -L.
  double axial = 0.0;
  //! The vector m' remains tangential: m · m' = 0.
  double tangent = 0.0;

  [[nodiscard]] double worst() const { return std::max({radial, polar, unit, axial, tangent}); }

  void take(const IntegralMisses& other) {
    // The comparison is such that the result is NaN if an argument is NaN.
    const auto larger = [](double a, double b) { return b <= a ? a : b; };
    radial = larger(radial, other.radial);
    polar = larger(polar, other.polar);
    unit = larger(unit, other.unit);
    axial = larger(axial, other.axial);
    tangent = larger(tangent, other.tangent);
  }
};

//! Computes the errors at a point of a ray; `s` contains derivatives in Mino time. All terms are
//! computed in double.
template <class S>
IntegralMisses integral_misses(double spin, const RayStart<S>& exact, const RayState<S>& s) {
  const double a2 = spin * spin;
  const double c = exact.polar_constant;
  const double l = exact.axial_angular_momentum;
  const double k = exact.shear_constant;
  const double u = s.u;
  const double quartic = a2 * (c - l * l) * u * u * u * u;
  const double potential = 1.0 + (a2 - c) * u * u + 2.0 * k * u * u * u - quartic;
  const double radial_scale = 1.0 + std::abs(a2 - c) * u * u + 2.0 * std::abs(k) * u * u * u + std::abs(quartic);
  const Vector3<double> m = {s.m.x, s.m.y, s.m.z};
  const Vector3<double> rate = {s.m_rate.x, s.m_rate.y, s.m_rate.z};
  const double speed2 = std::abs(c) + a2;
  const double turning = m.x * rate.y - m.y * rate.x;
  const double at_start = static_cast<double>(exact.m.x) * static_cast<double>(exact.m_rate.y) -
                          static_cast<double>(exact.m.y) * static_cast<double>(exact.m_rate.x);
  const double speed = std::sqrt(speed2) + 1e-6;
  return {std::abs(static_cast<double>(s.u_rate) * static_cast<double>(s.u_rate) - potential) / radial_scale,
          std::abs(dot(rate, rate) - c - a2 * m.z * m.z) / (speed * speed), std::abs(dot(m, m) - 1.0),
          std::abs(turning - at_start) / speed, std::abs(dot(m, rate)) / speed};
}

//! The result of following a ray: where it ends, and its largest errors on the way.
template <class S>
struct Walk {
  Vector3<S> sky;
  int steps = 0;
  bool reached = false;
  IntegralMisses misses;
};

//! Follows a ray from the camera to the sky as trace_taylor does. Checks the first integrals in the
//! middle and at the end of every step.
template <int Order, class S>
Walk<S> walk(S spin, const RayStart<S>& start, S tolerance, int step_limit) {
  const S polar_speed = safe_sqrt(std::max(start.polar_constant, S(0))) + S(1);
  const S inverse_scale = S(1) / polar_speed;
  const S local = local_tolerance(spin, start, IntegrationSettings{static_cast<double>(tolerance), step_limit});
  const auto coefficients = taylor_coefficients(spin, start, inverse_scale);
  RayState<S> state = initial_state(start);
  state.u_rate *= inverse_scale;
  state.m_rate = inverse_scale * state.m_rate;
  const auto in_mino_time = [&](RayState<S> s) {
    s.u_rate *= polar_speed;
    s.m_rate = polar_speed * s.m_rate;
    return s;
  };
  Walk<S> walked;
  TaylorSeries<Order, S> series;
  while (walked.steps < step_limit && !walked.reached) {
    expand(spin, coefficients, state, series);
    S h = std::min(S(3), detail::step_length(series, local, polar_speed));
    walked.reached = series_value(series.u, h) <= S(0);
    h = walked.reached ? detail::time_to_infinity(series, h) : h;
    walked.misses.take(integral_misses(spin, start, in_mino_time(evaluate(series, S(0.5) * h))));
    state = evaluate(series, h);
    walked.misses.take(integral_misses(spin, start, in_mino_time(state)));
    ++walked.steps;
  }
  walked.sky = sky_direction(state);
  return walked;
}

}  // namespace ergodome::test
