#pragma once

#include "kernels/near_rays/series_search.h"

// Reads the crossings of the equatorial plane from a ray's series.
namespace ergodome::inline ERGO_TARGET {

//! A position in the equatorial plane from which light comes.
template <class T>
struct EquatorialCrossing {
  //! 1 / r [1/M]; 0 if there is no crossing. Without WithDelay, crossings past infinity (u < 0) and
  //! behind the horizon are stored as well.
  T u;
  T u_rate;        //!< du/dλ (λ: Mino time), backwards: positive for light emitted outwards
  T x, y;          //!< (cosφ, sinφ) without frame dragging; only with WithDelay
  T drag;          //!< φ is the angle of (x, y) plus this [rad]; only with WithDelay
  T delay;         //!< coordinate time from emission to the camera [M]; only with WithDelay
  RealOf<T> time;  //!< Mino time from the crossing to the camera, for a photon seen with energy 1 [1/M]
};

namespace detail {

constexpr NearParts disk_parts(bool with_delay) {
  return with_delay ? NearParts::azimuth_and_delay : NearParts::position_alone;
}

//! Copies a crossing, in the lanes of a mask, from `from` to `to`.
template <class Mask, class T>
ERGO_HD void keep_crossing(const Mask& mask, const EquatorialCrossing<T>& from, EquatorialCrossing<T>& to) {
  to = {select(mask, from.u, to.u),      select(mask, from.u_rate, to.u_rate), select(mask, from.x, to.x),
        select(mask, from.y, to.y),      select(mask, from.drag, to.drag),     select(mask, from.delay, to.delay),
        select(mask, from.time, to.time)};
}

template <int Order, class T, NearParts Parts>
ERGO_HD EquatorialCrossing<T> crossing_at(const SeriesReading<T>& reading, const NearSeries<Order, T, Parts>& s,
                                          const T& h, const RealOf<T>& start) {
  const T none(ScalarOf<T>(0));
  EquatorialCrossing<T> crossing = {series_value(s.u, h),
                                    series_rate(s.u, h) * reading.scale,
                                    none,
                                    none,
                                    none,
                                    none,
                                    start + value_of(h) / reading.scale};
  if constexpr (has_delay(Parts)) {
    crossing.x = series_value(s.x, h);
    crossing.y = series_value(s.y, h);
    crossing.drag = series_value(s.drag, h);
    crossing.delay = series_value(s.delay, h);
    reading.count_outside(crossing.u, crossing.drag, crossing.delay);
  }
  return crossing;
}

//! Returns the sign of z, or `otherwise` if z is 0.
template <class Real>
ERGO_HD Real side_of(const Real& z, const Real& otherwise) {
  using S = ScalarOf<Real>;
  return select(z > Real(S(0)), Real(S(1)), select(z < Real(S(0)), Real(S(-1)), otherwise));
}

//! Returns the lanes whose ray, followed backwards, enters the horizon before the end of a step,
//! even if it turns behind the horizon. Light on the part after such a turn would come from another
//! universe.
template <int Order, class T, NearParts Parts>
ERGO_HD MaskOf<RealOf<T>> falls_within(const NearSeries<Order, T, Parts>& s, const RealOf<T>& length,
                                       ScalarOf<T> horizon_r) {
  using S = ScalarOf<T>;
  using Real = RealOf<T>;
  const Real zero(S(0));
  Real u[Order + 1];
  ERGO_UNROLL
  for (int k = 0; k <= Order; ++k) {
    u[k] = value_of(s.u[k]);
  }
  Real highest = series_value(u, length);
  const auto turns = (u[1] > zero) & (series_rate(u, length) < zero);
  if (any(turns)) {
    Real low = zero;
    Real high = length;
    constexpr int rounds = 10;
    for (int round = 0; round < rounds; ++round) {
      const Real middle = S(0.5) * (low + high);
      const auto before = series_rate(u, middle) > zero;
      low = select(before, middle, low);
      high = select(before, high, middle);
    }
    highest = select(turns, series_value(u, low), highest);
  }
  return highest * horizon_r > Real(S(1));
}

}  // namespace detail

}  // namespace ergodome::inline ERGO_TARGET
