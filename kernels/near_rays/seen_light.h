#pragma once

#include "kernels/core/arithmetic.h"
#include "kernels/core/vector3.h"

namespace ergodome::inline ERGO_TARGET {

//! Light that disk, shells and objects add to pixels, and how much of the background the pixels
//! still see (`clear`).
template <class T>
struct SeenLanes {
  T red, green, blue;
  T clear;
};

template <class T>
ERGO_HD SeenLanes<T> nothing_seen() {
  using S = ScalarOf<T>;
  return {T(S(0)), T(S(0)), T(S(0)), T(S(1))};
}

//! Adds a surface behind all that lane `i` has seen so far. `light` is already multiplied by the
//! opacity.
template <class T>
ERGO_HD void put_behind(const Vector3<float>& light, float opacity, int i, SeenLanes<T>& seen) {
  const float clear = lane(seen.clear, i);
  set_lane(seen.red, i, lane(seen.red, i) + clear * light.x);
  set_lane(seen.green, i, lane(seen.green, i) + clear * light.y);
  set_lane(seen.blue, i, lane(seen.blue, i) + clear * light.z);
  set_lane(seen.clear, i, clear * (1.0F - opacity));
}

template <class T>
ERGO_HD SeenLanes<T> operator+(const SeenLanes<T>& a, const SeenLanes<T>& b) {
  return {a.red + b.red, a.green + b.green, a.blue + b.blue, a.clear + b.clear};
}

}  // namespace ergodome::inline ERGO_TARGET
