#pragma once

#include "kernels/spacetime/geodesic/integration_settings.h"
#include "kernels/spacetime/geodesic/radial_potential.h"

// Shared by all integrators of null geodesics: state, sky direction and local tolerance.
namespace ergodome::inline ERGO_TARGET {

//! A ray on its way: position and rate in Mino time, and the frame dragging ψ accumulated so far.
template <class T>
struct RayState {
  T u;
  T u_rate;
  Vector3<T> m;
  Vector3<T> m_rate;
  T drag;  //!< frame dragging ψ [rad], backwards
};

//! Returns the lanes whose light moves only inwards on its way to the camera.
template <class T>
ERGO_HD MaskOf<RealOf<T>> only_comes_in(const RayStart<T>& start) {
  return value_of(start.u_rate) < RealOf<T>(ScalarOf<T>(0));
}

template <class T>
ERGO_HD RayState<T> initial_state(const RayStart<T>& start) {
  const T zero(ScalarOf<T>(0));
  const T drag = start.ingoing ? select(only_comes_in(start), T(start.turn), zero) : zero;
  return {start.u, start.u_rate, start.m, start.m_rate, drag};
}

//! Returns the sky direction of a ray at u = 0: its polar position, rotated about the spin axis by
//! the frame dragging.
template <class T>
ERGO_HD Vector3<T> sky_direction(const RayState<T>& end) {
  T sine;
  T cosine;
  sine_cosine(end.drag, sine, cosine);
  return {cosine * end.m.x - sine * end.m.y, sine * end.m.x + cosine * end.m.y, end.m.z};
}

//! Returns a ray without its derivatives.
template <class T>
ERGO_HD RayStart<RealOf<T>> plain_start(const RayStart<T>& start) {
  return {value_of(start.axial_angular_momentum),
          value_of(start.polar_constant),
          value_of(start.shear_constant),
          value_of(start.u),
          value_of(start.u_rate),
          {value_of(start.m.x), value_of(start.m.y), value_of(start.m.z)},
          {value_of(start.m_rate.x), value_of(start.m_rate.y), value_of(start.m_rate.z)},
          value_of(start.energy),
          start.ingoing,
          start.turn};
}

//! Returns the tolerance of local errors. Near the critical curve an error grows by 1 / distance,
//! so the tolerance shrinks in proportion to the ray's distance from it. Exception: with
//! IntegrationSettings::on_screen, the tolerance applies to the camera's sky and does not shrink.
//!
//! That distance is proportional to the clearance at the barrier, which is known before the first
//! step.
template <class T>
ERGO_HD RealOf<T> local_tolerance(ScalarOf<T> spin, const RayStart<T>& start, const IntegrationSettings& settings) {
  using Real = RealOf<T>;
  using S = ScalarOf<T>;
  const S tolerance = static_cast<S>(settings.tolerance);
  // The tolerance is kept above rounding errors, below which smaller values gain nothing.
  const Real min_value(S(0.25) * std::numeric_limits<S>::epsilon());
  if (settings.on_screen) {
    return maximum(Real(tolerance), min_value);
  }
  const S horizon_r = S(1) + safe_sqrt(S(1) - spin * spin);
  const Real height = absolute(radial_barrier(spin, horizon_r, plain_start(start)).clearance);
  return maximum(tolerance * minimum(height, Real(S(1))), min_value);
}

}  // namespace ergodome::inline ERGO_TARGET
