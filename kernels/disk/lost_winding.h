#pragma once

#include "kernels/near_rays/horizon_winding.h"

namespace ergodome::inline ERGO_TARGET {

namespace detail {

//! What azimuth and time lose of the winding: once, and what is counted in ingoing Kerr coordinates once more where the winding is that of light that
//! goes on to the horizon, and not at all where it is its own.
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
