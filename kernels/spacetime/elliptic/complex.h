#pragma once

#include <cmath>

#include "kernels/core/host_device.h"

namespace ergodome::inline ERGO_TARGET {

//! A complex number for device code, which cannot use std::complex.
struct Complex {
  double re;
  double im;

  ERGO_HD Complex(double real = 0.0, double imaginary = 0.0)
      : re(real), im(imaginary) {}  // NOLINT(google-explicit-constructor)
};

// clang-format off
ERGO_HD Complex operator+(const Complex& a, const Complex& b) { return {a.re + b.re, a.im + b.im}; }
ERGO_HD Complex operator-(const Complex& a, const Complex& b) { return {a.re - b.re, a.im - b.im}; }
ERGO_HD Complex operator*(const Complex& a, const Complex& b) { return {a.re * b.re - a.im * b.im, a.re * b.im + a.im * b.re}; }
ERGO_HD double size_of(const Complex& a) { return ::hypot(a.re, a.im); }
// clang-format on

ERGO_HD Complex operator/(const Complex& a, const Complex& b) {
  const double scale = 1.0 / (b.re * b.re + b.im * b.im);
  return {(a.re * b.re + a.im * b.im) * scale, (a.im * b.re - a.re * b.im) * scale};
}

//! Returns the principal square root, whose real part is not negative.
ERGO_HD Complex sqrt(const Complex& a) {
  if (a.im == 0.0) {
    return a.re >= 0.0 ? Complex(::sqrt(a.re), 0.0) : Complex(0.0, ::sqrt(-a.re));
  }
  const double half = 0.5 * (::hypot(a.re, a.im) + ::fabs(a.re));
  const double root = ::sqrt(half);
  const double other = 0.5 * a.im / root;
  return a.re >= 0.0 ? Complex(root, other) : Complex(::fabs(other), a.im >= 0.0 ? root : -root);
}

}  // namespace ergodome::inline ERGO_TARGET
