#pragma once

#include "kernels/spacetime/geodesic/timelike_orbit.h"
#include "kernels/spacetime/kerr/observer.h"

// Freely falling bodies in ingoing Kerr coordinates, which may cross the horizon.
namespace ergodome {

//! A freely falling body in ingoing Kerr coordinates, with its constants of motion.
struct RainOrbit {
  OrbitConstants constants;
  OrbitState state;
};

inline namespace ERGO_TARGET {

//! Returns the body that passes (r, θ) at azimuth `phi` of ingoing Kerr coordinates, with the given
//! velocity (|v| < 1) in the rain frame. Valid outside the horizon and inside it, also on the spin
//! axis. The inverse of orbit_rain_velocity(), by the same sums.
ERGO_HD RainOrbit make_rain_orbit(Spacetime spacetime, double r, double theta, double phi,
                                  const Vector3<double>& velocity) {
  const KerrFunctions f = kerr_functions(spacetime, r, theta);
  const double gamma = 1.0 / ::sqrt(1.0 - dot(velocity, velocity));
  const Vector3<double> south = {::cos(theta) * ::cos(phi), ::cos(theta) * ::sin(phi), -::sin(theta)};
  const Vector3<double> east = {-::sin(phi), ::cos(phi), 0.0};
  RainOrbit orbit{};
  OrbitState& s = orbit.state;
  s.u = 1.0 / r;
  s.u_rate = gamma * (f.rain_speed - velocity.x) * ::sqrt(f.area) / (r * r);
  s.m = {::sin(theta) * ::cos(phi), ::sin(theta) * ::sin(phi), ::cos(theta)};
  s.m_rate = (gamma * velocity.y * ::sqrt(f.sigma)) * south + (gamma * velocity.z * f.circumference_factor) * east;
  const double axial = gamma * velocity.z * f.circumference_factor * ::sin(theta);
  const double energy = gamma * (1.0 - f.rain_speed * velocity.x) + f.frame_dragging * axial;
  const double a_cosine = spacetime.spin * ::cos(theta);
  orbit.constants = {energy, axial, dot(s.m_rate, s.m_rate) + a_cosine * a_cosine * (1.0 - energy * energy), true};
  return orbit;
}

//! Returns whether a body outside the horizon falls in: no turning point of its radius lies below
//! it, and it moves inwards or is bound.
//!
//! U(u) of orbit_rate() is only sampled, so an orbit that just grazes a turning point may be taken
//! for one that falls in.
ERGO_HD bool falls_in(Spacetime spacetime, const OrbitConstants& c, const OrbitState& s) {
  const double spin = spacetime.spin;
  constexpr int samples = 400;
  if (!(s.u_rate >= 0.0) && !(c.energy < 1.0)) {
    return false;
  }
  const double skew = spin * (spin * c.energy - c.axial_angular_momentum);
  const double shear = c.polar_constant + spin * c.energy * (spin * c.energy - 2.0 * c.axial_angular_momentum);
  const double last = 1.0 / horizon_radius(spacetime);
  for (int i = 1; i <= samples; ++i) {
    const double u = s.u + (last - s.u) * i / samples;
    const double moment = c.energy + skew * u * u;
    if (!(moment * moment > (1.0 - 2.0 * u + spin * spin * u * u) * (1.0 + shear * u * u))) {
      return false;
    }
  }
  return true;
}

}  // namespace ERGO_TARGET
}  // namespace ergodome
