#pragma once

#include "kernels/spacetime/geodesic/polar_closed_form.h"
#include "kernels/spacetime/geodesic/radial_closed_form.h"

namespace ergodome::inline ERGO_TARGET {

//! Computes the end of a ray that is known to come from the sky, by elliptic integrals and
//! functions. Always in double, one ray at a time.
//!
//! The error estimate is that of rounding, which is amplified near the critical curve and where the
//! horizons of the hole are close to each other.
ERGO_HD RayEnd<double> trace_closed_form(double spin, const RayStart<double>& start) {
  const RadialMotion radial = radial_motion(spin, start);
  const Vector3<double> m = polar_position(spin, start, radial.time);
  const double sine = ::sin(radial.drag);
  const double cosine = ::cos(radial.drag);
  const double horizon_r = horizon_radius(Spacetime{spin});
  const double height = ::fabs(radial_barrier(spin, horizon_r, start).clearance);
  return {{cosine * m.x - sine * m.y, sine * m.x + cosine * m.y, m.z},
          radial.time,
          1e-15 * (1.0 + 1.0 / (height + 1e-300)) + radial.drag_error};
}

}  // namespace ergodome::inline ERGO_TARGET
