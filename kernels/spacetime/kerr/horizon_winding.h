#pragma once

#include "kernels/core/dual.h"
#include "kernels/core/transcendental.h"

// The winding W(u): the part of time and azimuth that all light has in common on its way to the
// horizon, where both grow without limit.
//
// With Δ u² = (1 - r_+ u)(1 - r_- u), light that is followed inwards has dt/du -> 2 r_+ / (Δ u²)
// and dφ/du -> -a / (Δ u²), whatever its constants are. So t - 2 r_+ W and φ + a W, with
//   W = ∫ du / (Δ u²) = ln(1 + d q) / d, q = u / (1 - r_+ u), d = r_+ - r_-,
// stay smooth on the way; for d -> 0, W = q.
//
// For a camera within the horizon, whose light came in through the horizon and is followed back
// out, the signs are opposite: t + 2 r_+ W and φ - a W stay smooth. These are ingoing Kerr
// coordinates, with a time that equals Boyer-Lindquist's far away.
namespace ergodome::inline ERGO_TARGET {

template <class S>
struct HorizonWinding {
  S spin;
  S horizon_r;  //!< radius of the outer horizon, r_+ [M]
  S gap;        //!< d = r_+ - r_-, between both horizons [M]
  //! Sign of W: 1 for light followed in to the horizon, -1 for light followed out of it from a
  //! camera within.
  S sense;
};

//! Returns the winding about a hole. `within`: the camera is within the horizon.
template <class S>
ERGO_HD HorizonWinding<S> horizon_winding(S spin, bool within = false) {
  const S half = safe_sqrt((S(1) - spin) * (S(1) + spin));
  return {spin, S(1) + half, S(2) * half, within ? S(-1) : S(1)};
}

//! Return the factors by which W enters the time (winding_delay) and the azimuth (winding_turn).
template <class S>
ERGO_HD S winding_delay(const HorizonWinding<S>& w) {
  return S(2) * (w.sense * w.horizon_r);
}
template <class S>
ERGO_HD S winding_turn(const HorizonWinding<S>& w) {
  return -(w.sense * w.spin);
}

namespace detail {

template <class T>
ERGO_HD T logarithm_of(const T& a) {
  return natural_logarithm(a);
}

template <class T>
ERGO_HD Dual<T> logarithm_of(const Dual<T>& a) {
  const T inverse = ScalarOf<T>(1) / a.value;
  return {natural_logarithm(a.value), a.along_x * inverse, a.along_y * inverse};
}

template <class T>
ERGO_HD MixedDual<T> logarithm_of(const MixedDual<T>& a) {
  const T inverse = ScalarOf<T>(1) / a.value;
  const T x = a.along_x * inverse;
  const T y = a.along_y * inverse;
  return {natural_logarithm(a.value), x, y, a.mixed * inverse - x * y};
}

//! Returns 1 - r_+ u, but at least 1e-6.
template <class T>
ERGO_HD T outer_part(const HorizonWinding<ScalarOf<T>>& w, const T& u) {
  using S = ScalarOf<T>;
  const T rest = S(1) - w.horizon_r * u;
  const T minimum(RealOf<T>(S(1e-6)));
  return select(value_of(rest) > value_of(minimum), rest, minimum);
}

}  // namespace detail

//! Returns W(u).
template <class T>
ERGO_HD T winding(const HorizonWinding<ScalarOf<T>>& w, const T& u) {
  using S = ScalarOf<T>;
  const T q = u / detail::outer_part(w, u);
  // Beyond infinity (u < 0) W does not matter, but the logarithm's argument has to stay positive.
  const T part = w.gap * q;
  const T argument = S(1) + part;
  const T minimum(RealOf<T>(S(1e-3)));
  const auto logarithm = [&] {
    return detail::logarithm_of(select(value_of(argument) > value_of(minimum), argument, minimum)) * (S(1) / w.gap);
  };
  if (w.gap > S(2e-3)) {
    return logarithm();
  }
  // If the horizons are close together, the logarithm of numbers next to 1 loses all digits, so its
  // series is summed instead.
  constexpr int terms = sizeof(S) == 4 ? 6 : 14;
  T series(RealOf<T>(S(1.0 / terms)));
  ERGO_UNROLL
  for (int k = terms - 1; k >= 1; --k) {
    series = S(1.0 / k) - part * series;
  }
  const auto far = value_of(part) > RealOf<T>(S(0.1));
  return any(far) ? select(far, logarithm(), q * series) : q * series;
}

//! Returns dW/du.
template <class T>
ERGO_HD T winding_rate(const HorizonWinding<ScalarOf<T>>& w, const T& u) {
  using S = ScalarOf<T>;
  const T outer = detail::outer_part(w, u);
  const T inner = S(1) - (w.horizon_r - w.gap) * u;
  return T(RealOf<T>(S(1))) / (outer * inner);
}

}  // namespace ergodome::inline ERGO_TARGET
