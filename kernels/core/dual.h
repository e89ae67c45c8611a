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

//! An operand without derivatives, excluded from template deduction: T, or a type that converts to
//! it.
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

}  // namespace ergodome::inline ERGO_TARGET
