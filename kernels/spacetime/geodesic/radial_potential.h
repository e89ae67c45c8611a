#pragma once

#include "kernels/core/arithmetic.h"
#include "kernels/spacetime/kerr/ray.h"

// The radial potential of null geodesics: which rays come from the sky.
namespace ergodome::inline ERGO_TARGET {

//! Position of the potential barrier of a ray, and whether light passes it.
//!
//! Outside the horizon U is positive at both ends and has at most two roots: a barrier that turns
//! light back. Its extrema are u = 0 and the roots of a quadratic. So the top of the barrier has a
//! closed form, and the sign of one number decides whether light passes, without solving a quartic
//! or integrating.
template <class T>
struct RadialBarrier {
  T u;  //!< where U is lowest between infinity and horizon [1/M]; 0 without a minimum
  //! (X - √(K Δ)) / r² at that u, with X = r² + a² - a L. Negative if light turns back; 1 if U has
  //! no minimum outside the horizon.
  T clearance;
};

//! Returns U(u) = 1 + (a² - C) u² + 2 K u³ - a² Q u⁴ = (du/dλ)²; λ: Mino time.
template <class T>
ERGO_HD T radial_potential(ScalarOf<T> spin, const RayStart<T>& ray, const T& u) {
  using S = ScalarOf<T>;
  const S a2 = spin * spin;
  const T carter = ray.polar_constant - ray.axial_angular_momentum * ray.axial_angular_momentum;
  return S(1) + u * u * ((a2 - ray.polar_constant) + u * (S(2) * ray.shear_constant - a2 * carter * u));
}

//! Finds the barrier from U' / 2u = (a² - C) + 3 K u - 2 a² Q u² = 0. `horizon_r` is r_+.
//!
//! U = (X u²)² - K u² (Δ u²) with X = r² + a² - a L is a difference of squares. Its factor X u² - u
//! √(K Δ u²) passes through zero linearly where U does. It keeps its sign where U only touches
//! zero: at the horizon of an extremal hole, whose shadow has a straight side there.
template <class T>
ERGO_HD RadialBarrier<T> radial_barrier(ScalarOf<T> spin, ScalarOf<T> horizon_r, const RayStart<T>& ray) {
  using S = ScalarOf<T>;
  const S a2 = spin * spin;
  const T zero(S(0));
  const T c = ray.polar_constant - a2;
  const T carter = ray.polar_constant - ray.axial_angular_momentum * ray.axial_angular_momentum;
  const T b = S(3) * ray.shear_constant;
  const T discriminant = b * b - (S(8) * a2) * (carter * c);
  const auto has_minimum = (c > zero) & (discriminant > zero);
  // The smaller positive root, in the form without cancellation and without division by the spin.
  const T denominator = select(has_minimum, b + safe_sqrt(discriminant), T(S(1)));
  const T u = select(has_minimum, S(2) * c / denominator, zero);
  const T lapse = (S(1) - horizon_r * u) * (S(1) - (a2 / horizon_r) * u);
  const T clearance =
      S(1) + (a2 - spin * ray.axial_angular_momentum) * u * u - u * safe_sqrt(ray.shear_constant * lapse);
  const auto outside_horizon = has_minimum & (horizon_r * u < T(S(1)));
  return {select(outside_horizon, u, zero), select(outside_horizon, clearance, T(S(1)))};
}

//! Returns a signed darkness of a ray: negative if its light comes from the sky, positive if it
//! would come from the hole. On the camera's sky it passes through zero linearly at the shadow's
//! edge.
//!
//! Outside the barrier all light that meets it turns back to infinity; inside the barrier no light
//! escapes; without a barrier the initial direction decides. Light with E <= 0 does not come from
//! infinity. With u_b the top of the barrier,
//!   U(u) = U(u_b) + (u - u_b)² q,   so   U(u_b) = (u' - (u_b - u) √q) (u' + (u_b - u) √q)
//! and only the first factor is zero on the edge, on either side of the barrier. It remains linear
//! for a camera at a photon orbit (u = u_b), where the clearance only touches zero; far from the
//! barrier the clearance is more precise.
template <class T>
ERGO_HD T darkness(ScalarOf<T> spin, ScalarOf<T> horizon_r, const RayStart<T>& ray) {
  using S = ScalarOf<T>;
  const T zero(S(0));
  const T one(S(1));
  const RadialBarrier<T> barrier = radial_barrier(spin, horizon_r, ray);
  const S a2 = spin * spin;
  const T carter = ray.polar_constant - ray.axial_angular_momentum * ray.axial_angular_momentum;
  const T q = (a2 - ray.polar_constant) + S(2) * ray.shear_constant * (ray.u + S(2) * barrier.u) -
              a2 * carter * (ray.u * ray.u + S(2) * ray.u * barrier.u + S(3) * barrier.u * barrier.u);
  const T beside = barrier.u - ray.u;
  const T near_value = ray.u_rate - beside * safe_sqrt(q);
  const auto outwards = ray.u_rate < zero;
  const T far_value =
      select(beside > zero, select(outwards, -one, barrier.clearance), select(outwards, -barrier.clearance, one));
  const auto near_barrier = absolute(beside) < S(0.5) * barrier.u;
  const T with_barrier = select(near_barrier, near_value, far_value);
  const T value = select(barrier.u > zero, with_barrier, ray.u_rate);
  return select(ray.energy > zero, value, one);
}

//! Returns whether a ray comes from the sky, without tracing it.
template <class T>
ERGO_HD MaskOf<T> comes_from_sky(ScalarOf<T> spin, ScalarOf<T> horizon_r, const RayStart<T>& ray) {
  return darkness(spin, horizon_r, ray) < T(ScalarOf<T>(0));
}

}  // namespace ergodome::inline ERGO_TARGET
