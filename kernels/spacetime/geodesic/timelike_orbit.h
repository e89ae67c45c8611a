#pragma once

#include "kernels/core/arithmetic.h"
#include "kernels/core/vector3.h"
#include "kernels/spacetime/geodesic/tableau.h"
#include "kernels/spacetime/kerr/kerr.h"

// Freely falling bodies: timelike geodesics of Kerr spacetime.
namespace ergodome {

//! Constants of motion of a freely falling body of mass 1.
struct OrbitConstants {
  double energy;                  //!< E at infinity; 1 for a body that is at rest at infinity
  double axial_angular_momentum;  //!< L_z of the body [M]
  double polar_constant;          //!< Q + L_z² [M²], with Carter's Q
  //! Azimuth and time are those of ingoing Kerr coordinates, in which bodies cross the horizon: dφ
  //! + (a/Δ) dr, dt + ((r² + a²)/Δ) dr.
  bool ingoing = false;
};

//! A freely falling body at one instant, without singularities at poles and turning points: u = 1 /
//! r, and the polar position as a point on the unit sphere whose azimuth excludes frame dragging.
//! Rates are in Mino time λ, dτ = Σ dλ.
struct OrbitState {
  double u;                //!< 1 / r [1/M]
  double u_rate;           //!< du/dλ
  Vector3<double> m;       //!< (sinθ cosψ, sinθ sinψ, cosθ); ψ: azimuth without frame dragging
  Vector3<double> m_rate;  //!< dm/dλ [M]
  double drag;             //!< azimuth by frame dragging, φ - ψ [rad]
  double time;             //!< t since the start [M], Boyer-Lindquist unless `ingoing`
};

inline namespace ERGO_TARGET {

//! Returns the body that passes (r, θ, φ) with the given velocity (|v| < 1) in the ZAMO frame; r
//! outside the horizon, also on the spin axis.
ERGO_HD OrbitState make_orbit(Spacetime spacetime, double r, double theta, double phi,
                              const Vector3<double>& velocity) {
  const KerrFunctions f = kerr_functions(spacetime, r, theta);
  const double gamma = 1.0 / ::sqrt(1.0 - dot(velocity, velocity));
  const double u = 1.0 / r;
  const Vector3<double> south = {::cos(theta) * ::cos(phi), ::cos(theta) * ::sin(phi), -::sin(theta)};
  const Vector3<double> east = {-::sin(phi), ::cos(phi), 0.0};
  OrbitState s{};
  s.u = u;
  s.u_rate = -u * u * gamma * velocity.x * ::sqrt(f.sigma * f.delta);
  s.m = {::sin(theta) * ::cos(phi), ::sin(theta) * ::sin(phi), ::cos(theta)};
  s.m_rate = (gamma * velocity.y * ::sqrt(f.sigma)) * south + (gamma * velocity.z * f.circumference_factor) * east;
  return s;
}

namespace detail {

//! Momentum in the ZAMO frame, with L_z and the metric functions that it is computed from.
struct OrbitMomentum {
  KerrFunctions f;
  double radial;     //!< γ v_r of the body in the ZAMO frame
  double polar;      //!< γ v_θ of the body in the ZAMO frame
  double azimuthal;  //!< γ v_φ of the body in the ZAMO frame
  double axial;      //!< L_z [M]
};

ERGO_HD OrbitMomentum momentum_of(Spacetime spacetime, const OrbitState& s) {
  OrbitMomentum p{};
  p.f = kerr_functions(spacetime, 1.0 / s.u, ::acos(::fmin(::fmax(s.m.z, -1.0), 1.0)));
  p.radial = -s.u_rate / (s.u * s.u * ::sqrt(p.f.sigma * p.f.delta));
  const double sine = ::sqrt(s.m.x * s.m.x + s.m.y * s.m.y);
  p.axial = s.m.x * s.m_rate.y - s.m.y * s.m_rate.x;
  // On the spin axis every direction is equivalent, and both lengths are the same.
  const double around = sine > 1e-150 ? p.axial / sine : ::sqrt(dot(s.m_rate, s.m_rate));
  const double south =
      sine > 1e-150 ? (s.m.z * (s.m.x * s.m_rate.x + s.m.y * s.m_rate.y) - sine * sine * s.m_rate.z) / sine : 0.0;
  p.polar = south / ::sqrt(p.f.sigma);
  p.azimuthal = around / p.f.circumference_factor;
  return p;
}

}  // namespace detail

//! Returns the velocity in the ZAMO frame (e_r, e_θ, e_φ).
ERGO_HD Vector3<double> orbit_velocity(Spacetime spacetime, const OrbitState& s) {
  const detail::OrbitMomentum p = detail::momentum_of(spacetime, s);
  const double gamma = ::sqrt(1.0 + p.radial * p.radial + p.polar * p.polar + p.azimuthal * p.azimuthal);
  return {p.radial / gamma, p.polar / gamma, p.azimuthal / gamma};
}

//! Returns the velocity in the ZAMO frame with e_θ and e_φ taken at the azimuth `psi`. That is the
//! body's ψ, except on the spin axis, where all directions are equivalent and the caller chooses
//! one.
ERGO_HD Vector3<double> orbit_velocity(Spacetime spacetime, const OrbitState& s, double psi) {
  const double sine = ::sqrt(s.m.x * s.m.x + s.m.y * s.m.y);
  const Vector3<double> south = {s.m.z * ::cos(psi), s.m.z * ::sin(psi), -sine};
  const Vector3<double> east = {-::sin(psi), ::cos(psi), 0.0};
  const detail::OrbitMomentum p = detail::momentum_of(spacetime, s);
  const double polar = dot(s.m_rate, south) / ::sqrt(p.f.sigma);
  const double azimuthal = dot(s.m_rate, east) / p.f.circumference_factor;
  const double gamma = ::sqrt(1.0 + p.radial * p.radial + polar * polar + azimuthal * azimuthal);
  return {p.radial / gamma, polar / gamma, azimuthal / gamma};
}

//! Returns the constants of motion, from position and velocity only.
ERGO_HD OrbitConstants orbit_constants(Spacetime spacetime, const OrbitState& s) {
  const detail::OrbitMomentum p = detail::momentum_of(spacetime, s);
  const double gamma = ::sqrt(1.0 + p.radial * p.radial + p.polar * p.polar + p.azimuthal * p.azimuthal);
  const double lapse = ::sqrt(p.f.sigma * p.f.delta / p.f.area);
  const double energy = lapse * gamma + p.f.frame_dragging * p.axial;
  const double a_cosine = spacetime.spin * s.m.z;
  return {energy, p.axial, dot(s.m_rate, s.m_rate) + a_cosine * a_cosine * (1.0 - energy * energy)};
}

//! Returns the velocity in the rain frame (e_r, e_θ, e_φ), also at the horizon and inside it; `psi`
//! as in orbit_velocity().
//!
//! With the body's momentum (ε, p) in the rain frame, v the rain's speed and ω the frame dragging
//! (see make_camera_station()),
//!   E - ω L = ε - v p_r,   (dr/dλ) / √A = p_r - v ε,   (ε - p_r)(ε + p_r) = 1 + p_θ² + p_φ².
//! The difference of the first two is (ε - p_r)(1 + v), which does not cancel for bodies that fall
//! inwards.
ERGO_HD Vector3<double> orbit_rain_velocity(Spacetime spacetime, const OrbitConstants& c, const OrbitState& s,
                                            double psi) {
  const double sine = ::sqrt(s.m.x * s.m.x + s.m.y * s.m.y);
  const Vector3<double> south = {s.m.z * ::cos(psi), s.m.z * ::sin(psi), -sine};
  const Vector3<double> east = {-::sin(psi), ::cos(psi), 0.0};
  const KerrFunctions f = kerr_functions(spacetime, 1.0 / s.u, ::atan2(sine, s.m.z));
  const double polar = dot(s.m_rate, south) / ::sqrt(f.sigma);
  const double azimuthal = dot(s.m_rate, east) / f.circumference_factor;
  const double inwards = s.u_rate / (s.u * s.u * ::sqrt(f.area));
  const double less = (c.energy - f.frame_dragging * c.axial_angular_momentum + inwards) / (1.0 + f.rain_speed);
  const double more = (1.0 + polar * polar + azimuthal * azimuthal) / less;
  const double energy = 0.5 * (more + less);
  return {0.5 * (more - less) / energy, polar / energy, azimuthal / energy};
}

namespace detail {

//! Rates of frame dragging and of time with respect to λ.
struct OrbitDrag {
  double drag;
  double time;
};

//! Computes the rates, in ingoing Kerr coordinates if OrbitConstants::ingoing. With P = E (r² + a²)
//! - a L and R = (dr/dλ)² = P² - Δ (r² + K), these contain (P + dr/dλ) / Δ, which is
//! (r² + K) / (P + √R) for bodies that fall inwards. `moment` is P u², `mass` is 1 + K u², `lapse`
//! is Δ u².
ERGO_HD OrbitDrag orbit_drag(Spacetime spacetime, const OrbitConstants& c, const OrbitState& s, double moment,
                             double mass, double lapse) {
  const double spin = spacetime.spin;
  const double a2 = spin * spin;
  const double u2 = s.u * s.u;
  const double sine_square = s.m.x * s.m.x + s.m.y * s.m.y;
  const double beside = spin * (c.axial_angular_momentum - spin * c.energy * sine_square);
  if (c.ingoing) {
    const double together = s.u_rate > 0.0 ? mass / (moment + s.u_rate) : (moment - s.u_rate) / lapse;
    return {spin * (together - c.energy), (1.0 + a2 * u2) * together / u2 + beside};
  }
  return {spin * s.u * (2.0 * c.energy - spin * c.axial_angular_momentum * s.u) / lapse,
          (1.0 + a2 * u2) * moment / lapse / u2 + beside};
}

}  // namespace detail

//! Returns the rate of every component of the state with respect to the body's proper time τ.
//!
//! Carter's potentials for mass 1 (Bardeen, Press & Teukolsky 1972, eq. 2.9), differentiated once:
//! with K = Q + (L - aE)²,
//!   (du/dλ)² = U(u) = [E + a (aE - L) u²]² - (1 - 2u + a² u²)(1 + K u²),      u'' = U'(u) / 2,
//!   |m'|² + a² (1 - E²) m_z² = Q + L²,      m'' = -|m'|² m - a² (1 - E²) m_z (e_z - m_z m).
ERGO_HD OrbitState orbit_rate(Spacetime spacetime, const OrbitConstants& c, const OrbitState& s) {
  const double spin = spacetime.spin;
  const double a2 = spin * spin;
  const double u2 = s.u * s.u;
  const double skew = spin * (spin * c.energy - c.axial_angular_momentum);
  const double shear = c.polar_constant + spin * c.energy * (spin * c.energy - 2.0 * c.axial_angular_momentum);
  const double lapse = 1.0 - 2.0 * s.u + a2 * u2;
  const double moment = c.energy + skew * u2;
  const double force = 2.0 * skew * s.u * moment + (1.0 - a2 * s.u) * (1.0 + shear * u2) - lapse * shear * s.u;
  const double spring = a2 * (1.0 - c.energy * c.energy) * s.m.z;
  const double bend = spring * s.m.z - dot(s.m_rate, s.m_rate);
  const double mino = u2 / (1.0 + a2 * u2 * s.m.z * s.m.z);  // dλ/dτ = 1/Σ
  const detail::OrbitDrag dragged = detail::orbit_drag(spacetime, c, s, moment, 1.0 + shear * u2, lapse);
  OrbitState rate{};
  rate.u = mino * s.u_rate;
  rate.u_rate = mino * force;
  rate.m = mino * s.m_rate;
  rate.m_rate = mino * Vector3<double>{bend * s.m.x, bend * s.m.y, bend * s.m.z - spring};
  rate.drag = mino * dragged.drag;
  rate.time = mino * dragged.time;
  return rate;
}

namespace detail {

ERGO_HD OrbitState moved(const OrbitState& s, double factor, const OrbitState& d) {
  return {s.u + factor * d.u,           s.u_rate + factor * d.u_rate, s.m + factor * d.m,
          s.m_rate + factor * d.m_rate, s.drag + factor * d.drag,     s.time + factor * d.time};
}

//! Returns the error of a state, relative to the state's size, as an angle [rad].
ERGO_HD double orbit_error(const OrbitConstants& c, const OrbitState& s, const OrbitState& e) {
  const auto sum = [](const Vector3<double>& v) { return ::fabs(v.x) + ::fabs(v.y) + ::fabs(v.z); };
  const double pace = ::sqrt(::fabs(c.polar_constant)) + 1.0;
  return ::fabs(e.u) / s.u + ::fabs(e.u_rate) / (pace * s.u) + sum(e.m) + sum(e.m_rate) / pace + ::fabs(e.drag);
}

}  // namespace detail

//! The end of a step along an orbit, and the difference between the solutions of both orders, as
//! an angle [rad].
struct OrbitStep {
  OrbitState end;
  double error;
};

//! Takes one step of Cash & Karp's pair over a proper time `h` [M]. The error is NaN too close to
//! the horizon, unless OrbitConstants::ingoing.
ERGO_HD OrbitStep orbit_step(Spacetime spacetime, const OrbitConstants& constants, double h, const OrbitState& state) {
  OrbitState stage[CashKarp::stages];
  OrbitState end = state;
  OrbitState difference{};
  for (int i = 0; i < CashKarp::stages; ++i) {
    OrbitState at = state;
    for (int j = 0; j < i; ++j) {
      at = detail::moved(at, CashKarp::a(i, j) * h, stage[j]);
    }
    stage[i] = orbit_rate(spacetime, constants, at);
    end = detail::moved(end, CashKarp::b(i) * h, stage[i]);
    difference = detail::moved(difference, (CashKarp::b(i) - CashKarp::b_embedded(i)) * h, stage[i]);
  }
  return {end, detail::orbit_error(constants, state, difference)};
}

//! Returns the factor for the length of the next step after a step with this error: from 0.2, also
//! for NaN, to 4. The caller repeats a step whose error exceeds the tolerance.
ERGO_HD double orbit_step_growth(double error, double tolerance) {
  constexpr double exponent = 1.0 / (CashKarp::error_order + 1);
  const double growth = 0.85 * ::pow(tolerance / (error + 1e-300), exponent);
  return growth > 0.2 ? ::fmin(growth, 4.0) : 0.2;
}

//! Follows a body for the proper time `duration` [M], backwards if negative, by Cash & Karp's pair
//! with errors below `tolerance` [rad] per step. Returns false, with the body at the last position,
//! if it gets too close to the horizon (unless OrbitConstants::ingoing) or `step_limit` is reached.
ERGO_HD bool advance_orbit(Spacetime spacetime, const OrbitConstants& constants, double duration, double tolerance,
                           int step_limit, OrbitState& state) {
  double done = 0.0;
  double h = duration;
  for (int step = 0; step < step_limit && done != duration; ++step) {
    const OrbitStep next = orbit_step(spacetime, constants, h, state);
    if (next.error <= tolerance) {  // false for NaN
      state = next.end;
      done = h == duration - done ? duration : done + h;
    }
    h *= orbit_step_growth(next.error, tolerance);
    h = ::fabs(h) < ::fabs(duration - done) ? h : duration - done;
  }
  return done == duration;
}

}  // namespace ERGO_TARGET
}  // namespace ergodome
