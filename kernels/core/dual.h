#pragma once

#include <type_traits>

#include "kernels/core/arithmetic.h"

namespace ergodome::inline ERGO_TARGET {

//! A number with its derivatives along two directions: exact first derivatives by forward-mode
//! differentiation.
//!
//! Comparisons and step control use the value only, so a computation on dual numbers takes the same
//! path as on plain numbers. Arithmetic rule: f(a + ε b) = f(a) + ε f'(a) b.
template <class T>
struct Dual {
  T value;
  T along_x;  //!< derivative along the first direction
  T along_y;  //!< derivative along the second direction

  Dual() = default;
  ERGO_HD Dual(const T& v)
      : value(v), along_x(ScalarOf<T>(0)), along_y(ScalarOf<T>(0)) {}  // NOLINT(google-explicit-constructor)
  ERGO_HD Dual(const T& v, const T& x, const T& y) : value(v), along_x(x), along_y(y) {}
};

template <class T>
struct RealTraits<Dual<T>> {
  using Scalar = ScalarOf<T>;
  using Real = T;
  using Mask = MaskOf<T>;
  static constexpr int lane_count = RealTraits<T>::lane_count;
};

//! An operand without derivatives: T, or a type that converts to it, because T is not deduced from
//! this operand.
template <class T>
using Plain = std::type_identity_t<T>;

// clang-format off
template <class T> ERGO_HD T value_of(const Dual<T>& a) { return a.value; }
template <class T> ERGO_HD Dual<T> operator-(const Dual<T>& a) { return {-a.value, -a.along_x, -a.along_y}; }
template <class T> ERGO_HD Dual<T> operator+(const Dual<T>& a, const Dual<T>& b) { return {a.value + b.value, a.along_x + b.along_x, a.along_y + b.along_y}; }
template <class T> ERGO_HD Dual<T> operator-(const Dual<T>& a, const Dual<T>& b) { return {a.value - b.value, a.along_x - b.along_x, a.along_y - b.along_y}; }
template <class T> ERGO_HD Dual<T> operator*(const Dual<T>& a, const Dual<T>& b) {
  return {a.value * b.value, a.value * b.along_x + a.along_x * b.value, a.value * b.along_y + a.along_y * b.value};
}
template <class T> ERGO_HD Dual<T> operator/(const Dual<T>& a, const Dual<T>& b) {
  const T inverse = ScalarOf<T>(1) / b.value;
  const T q = a.value * inverse;
  return {q, (a.along_x - q * b.along_x) * inverse, (a.along_y - q * b.along_y) * inverse};
}
template <class T> ERGO_HD Dual<T> operator+(const Dual<T>& a, const Plain<T>& s) { return {a.value + s, a.along_x, a.along_y}; }
template <class T> ERGO_HD Dual<T> operator-(const Dual<T>& a, const Plain<T>& s) { return {a.value - s, a.along_x, a.along_y}; }
template <class T> ERGO_HD Dual<T> operator*(const Dual<T>& a, const Plain<T>& s) { return {a.value * s, a.along_x * s, a.along_y * s}; }
template <class T> ERGO_HD Dual<T> operator+(const Plain<T>& s, const Dual<T>& a) { return a + s; }
template <class T> ERGO_HD Dual<T> operator-(const Plain<T>& s, const Dual<T>& a) { return {s - a.value, -a.along_x, -a.along_y}; }
template <class T> ERGO_HD Dual<T> operator*(const Plain<T>& s, const Dual<T>& a) { return a * s; }
template <class T> ERGO_HD Dual<T> operator/(const Plain<T>& s, const Dual<T>& a) { return Dual<T>(s) / a; }
template <class T> ERGO_HD MaskOf<T> operator<(const Dual<T>& a, const Dual<T>& b) { return a.value < b.value; }
template <class T> ERGO_HD MaskOf<T> operator>(const Dual<T>& a, const Dual<T>& b) { return a.value > b.value; }
template <class T> ERGO_HD MaskOf<T> operator<(const Dual<T>& a, const Plain<T>& s) { return a.value < s; }
template <class T> ERGO_HD MaskOf<T> operator>(const Dual<T>& a, const Plain<T>& s) { return a.value > s; }
template <class T, class M> ERGO_HD Dual<T> select(const M& mask, const Dual<T>& yes, const Dual<T>& no) {
  return {select(mask, yes.value, no.value), select(mask, yes.along_x, no.along_x), select(mask, yes.along_y, no.along_y)};
}
template <class T> ERGO_HD Dual<T> sqrt(const Dual<T>& a) {
  const T root = sqrt(a.value);
  const T half = ScalarOf<T>(0.5) / root;
  return {root, half * a.along_x, half * a.along_y};
}
template <class T> ERGO_HD void sine_cosine(const Dual<T>& angle, Dual<T>& sine, Dual<T>& cosine) {
  T s;
  T c;
  sine_cosine(angle.value, s, c);
  sine = {s, c * angle.along_x, c * angle.along_y};
  cosine = {c, -(s * angle.along_x), -(s * angle.along_y)};
}
// clang-format on

//! A number with its derivatives along two directions and the mixed second derivative, as the
//! corners of bicubic patches need.
//!
//! Forward-mode differentiation of second order without the pure second derivatives (Fike & Alonso,
//! AIAA 2011-886, "hyper-dual numbers"): f(a) = f + f' (a_x, a_y), with f'' a_x a_y + f' a_xy in
//! the mixed part. Comparisons use the value only.
template <class T>
struct MixedDual {
  T value;
  T along_x;
  T along_y;
  T mixed;  //!< mixed second derivative ∂²/∂x∂y

  MixedDual() = default;
  ERGO_HD MixedDual(const T& v)  // NOLINT(google-explicit-constructor)
      : value(v), along_x(ScalarOf<T>(0)), along_y(ScalarOf<T>(0)), mixed(ScalarOf<T>(0)) {}
  ERGO_HD MixedDual(const T& v, const T& x, const T& y, const T& xy) : value(v), along_x(x), along_y(y), mixed(xy) {}
};

template <class T>
struct RealTraits<MixedDual<T>> {
  using Scalar = ScalarOf<T>;
  using Real = T;
  using Mask = MaskOf<T>;
  static constexpr int lane_count = RealTraits<T>::lane_count;
};

template <class T>
inline constexpr bool has_mixed_part<MixedDual<T>> = true;

// clang-format off
template <class T> ERGO_HD T value_of(const MixedDual<T>& a) { return a.value; }
template <class T> ERGO_HD MixedDual<T> operator-(const MixedDual<T>& a) { return {-a.value, -a.along_x, -a.along_y, -a.mixed}; }
template <class T> ERGO_HD MixedDual<T> operator+(const MixedDual<T>& a, const MixedDual<T>& b) { return {a.value + b.value, a.along_x + b.along_x, a.along_y + b.along_y, a.mixed + b.mixed}; }
template <class T> ERGO_HD MixedDual<T> operator-(const MixedDual<T>& a, const MixedDual<T>& b) { return {a.value - b.value, a.along_x - b.along_x, a.along_y - b.along_y, a.mixed - b.mixed}; }
template <class T> ERGO_HD MixedDual<T> operator*(const MixedDual<T>& a, const MixedDual<T>& b) {
  return {a.value * b.value, a.value * b.along_x + a.along_x * b.value, a.value * b.along_y + a.along_y * b.value,
          (a.value * b.mixed + a.mixed * b.value) + (a.along_x * b.along_y + a.along_y * b.along_x)};
}
template <class T> ERGO_HD MixedDual<T> operator/(const MixedDual<T>& a, const MixedDual<T>& b) {
  const T inverse = ScalarOf<T>(1) / b.value;
  const T q = a.value * inverse;
  const T qx = (a.along_x - q * b.along_x) * inverse;
  const T qy = (a.along_y - q * b.along_y) * inverse;
  return {q, qx, qy, (a.mixed - q * b.mixed - qx * b.along_y - qy * b.along_x) * inverse};
}
template <class T> ERGO_HD MixedDual<T> operator+(const MixedDual<T>& a, const Plain<T>& s) { return {a.value + s, a.along_x, a.along_y, a.mixed}; }
template <class T> ERGO_HD MixedDual<T> operator-(const MixedDual<T>& a, const Plain<T>& s) { return {a.value - s, a.along_x, a.along_y, a.mixed}; }
template <class T> ERGO_HD MixedDual<T> operator*(const MixedDual<T>& a, const Plain<T>& s) { return {a.value * s, a.along_x * s, a.along_y * s, a.mixed * s}; }
template <class T> ERGO_HD MixedDual<T> operator+(const Plain<T>& s, const MixedDual<T>& a) { return a + s; }
template <class T> ERGO_HD MixedDual<T> operator-(const Plain<T>& s, const MixedDual<T>& a) { return {s - a.value, -a.along_x, -a.along_y, -a.mixed}; }
template <class T> ERGO_HD MixedDual<T> operator*(const Plain<T>& s, const MixedDual<T>& a) { return a * s; }
template <class T> ERGO_HD MixedDual<T> operator/(const Plain<T>& s, const MixedDual<T>& a) { return MixedDual<T>(s) / a; }
template <class T> ERGO_HD MaskOf<T> operator<(const MixedDual<T>& a, const Plain<T>& s) { return a.value < s; }
template <class T> ERGO_HD MaskOf<T> operator>(const MixedDual<T>& a, const Plain<T>& s) { return a.value > s; }
template <class T, class M> ERGO_HD MixedDual<T> select(const M& mask, const MixedDual<T>& yes, const MixedDual<T>& no) {
  return {select(mask, yes.value, no.value), select(mask, yes.along_x, no.along_x), select(mask, yes.along_y, no.along_y), select(mask, yes.mixed, no.mixed)};
}
template <class T> ERGO_HD MixedDual<T> sqrt(const MixedDual<T>& a) {
  const T root = sqrt(a.value);
  const T half = ScalarOf<T>(0.5) / root;
  return {root, half * a.along_x, half * a.along_y, half * a.mixed - (half / a.value) * (ScalarOf<T>(0.5) * a.along_x * a.along_y)};
}
template <class T> ERGO_HD void sine_cosine(const MixedDual<T>& angle, MixedDual<T>& sine, MixedDual<T>& cosine) {
  T s;
  T c;
  sine_cosine(angle.value, s, c);
  const T product = angle.along_x * angle.along_y;
  sine = {s, c * angle.along_x, c * angle.along_y, c * angle.mixed - s * product};
  cosine = {c, -(s * angle.along_x), -(s * angle.along_y), -(s * angle.mixed) - c * product};
}
// clang-format on

}  // namespace ergodome::inline ERGO_TARGET
