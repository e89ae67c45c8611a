#pragma once

#include "kernels/spacetime/kerr/horizon_winding.h"

namespace ergodome::inline ERGO_TARGET {

namespace detail {

//! Factors of the winding (kernels/spacetime/kerr/horizon_winding.h) that is subtracted from
//! azimuth and time, so that they stay smooth at the horizon. It is subtracted once in
//! Boyer-Lindquist coordinates. In ingoing Kerr coordinates it is subtracted twice for a camera
//! outside the horizon (HorizonWinding::sense 1), and not at all for one inside (sense -1).
template <class T>
struct LostWinding {
  using Real = RealOf<T>;
  HorizonWinding<ScalarOf<T>> horizon;
  Real turn;
  Real delay;

  ERGO_HD LostWinding(const HorizonWinding<ScalarOf<T>>& w, const MaskOf<Real>& ingoing)
      : horizon(w),
        turn(select(ingoing, Real((w.sense + ScalarOf<T>(1)) * winding_turn(w)), Real(winding_turn(w)))),
        delay(select(ingoing, Real((w.sense + ScalarOf<T>(1)) * winding_delay(w)), Real(winding_delay(w)))) {}
};

}  // namespace detail

}  // namespace ergodome::inline ERGO_TARGET
