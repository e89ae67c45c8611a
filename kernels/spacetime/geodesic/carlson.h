#pragma once

#include <cmath>

#include "kernels/core/host_device.h"

// Carlson's symmetric elliptic integrals by duplication: B. C. Carlson, Numerical Algorithms 10
// (1995) 13; DLMF 19.36. Arguments are complex, with at most one of x, y, z zero; none on the
// negative real axis.
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

namespace detail {
//! Maximum number of duplications. Each divides the spread of the arguments by four.
inline constexpr int duplication_limit = 40;
}  // namespace detail

//! Computes R_F(x, y, z) = ½ ∫_0^∞ dt / √((t + x)(t + y)(t + z)).
ERGO_HD Complex carlson_rf(Complex x, Complex y, Complex z) {
  for (int round = 0; round < detail::duplication_limit; ++round) {
    const Complex mean = (x + y + z) * Complex(1.0 / 3.0);
    const double spread = ::fmax(size_of(x - mean), ::fmax(size_of(y - mean), size_of(z - mean)));
    if (spread < 2e-3 * size_of(mean)) {
      break;
    }
    const Complex rx = sqrt(x);
    const Complex ry = sqrt(y);
    const Complex rz = sqrt(z);
    const Complex lambda = rx * ry + ry * rz + rz * rx;
    x = Complex(0.25) * (x + lambda);
    y = Complex(0.25) * (y + lambda);
    z = Complex(0.25) * (z + lambda);
  }
  const Complex mean = (x + y + z) * Complex(1.0 / 3.0);
  const Complex dx = (mean - x) / mean;
  const Complex dy = (mean - y) / mean;
  const Complex dz = Complex(0.0) - dx - dy;
  const Complex e2 = dx * dy - dz * dz;
  const Complex e3 = dx * dy * dz;
  const Complex series = Complex(1.0) - e2 * Complex(1.0 / 10) + e3 * Complex(1.0 / 14) + e2 * e2 * Complex(1.0 / 24) -
                         e2 * e3 * Complex(3.0 / 44) - e2 * e2 * e2 * Complex(5.0 / 208) + e3 * e3 * Complex(3.0 / 104);
  return series / sqrt(mean);
}

//! Computes R_C(x, y) = R_F(x, y, y).
ERGO_HD Complex carlson_rc(const Complex& x, const Complex& y) { return carlson_rf(x, y, y); }

//! Computes R_J(x, y, z, p) = 3/2 ∫_0^∞ dt / ((t + p) √((t + x)(t + y)(t + z))).
ERGO_HD Complex carlson_rj(Complex x, Complex y, Complex z, Complex p) {
  Complex sum(0.0);
  double power = 1.0;
  for (int round = 0; round < detail::duplication_limit; ++round) {
    const Complex mean = (x + y + z + p + p) * Complex(0.2);
    const double spread =
        ::fmax(::fmax(size_of(x - mean), size_of(p - mean)), ::fmax(size_of(y - mean), size_of(z - mean)));
    if (spread < 2e-3 * size_of(mean)) {
      break;
    }
    const Complex rx = sqrt(x);
    const Complex ry = sqrt(y);
    const Complex rz = sqrt(z);
    const Complex rp = sqrt(p);
    const Complex lambda = rx * ry + ry * rz + rz * rx;
    const Complex d = (rp + rx) * (rp + ry) * (rp + rz);
    const Complex e = (p - x) * (p - y) * (p - z) / (d * d);
    sum = sum + Complex(power) / d * carlson_rc(Complex(1.0), Complex(1.0) + e);
    power *= 0.25;
    x = Complex(0.25) * (x + lambda);
    y = Complex(0.25) * (y + lambda);
    z = Complex(0.25) * (z + lambda);
    p = Complex(0.25) * (p + lambda);
  }
  const Complex mean = (x + y + z + p + p) * Complex(0.2);
  const Complex dx = (mean - x) / mean;
  const Complex dy = (mean - y) / mean;
  const Complex dz = (mean - z) / mean;
  const Complex dp = Complex(-0.5) * (dx + dy + dz);
  const Complex e2 = dx * dy + dx * dz + dy * dz - Complex(3.0) * dp * dp;
  const Complex e3 = dx * dy * dz + Complex(2.0) * e2 * dp + Complex(4.0) * dp * dp * dp;
  const Complex e4 = (Complex(2.0) * dx * dy * dz + e2 * dp + Complex(3.0) * dp * dp * dp) * dp;
  const Complex e5 = dx * dy * dz * dp * dp;
  const Complex series = Complex(1.0) - e2 * Complex(3.0 / 14) + e3 * Complex(1.0 / 6) + e2 * e2 * Complex(9.0 / 88) -
                         e4 * Complex(3.0 / 22) - e2 * e3 * Complex(9.0 / 52) + e5 * Complex(3.0 / 26);
  return Complex(power) * series / (mean * sqrt(mean)) + Complex(6.0) * sum;
}

//! Computes R_F(x, y, z) = ½ ∫_0^∞ dt / √((t + x)(t + y)(t + z)) of real arguments that are not
//! negative, at most one of them zero. Uses duplication like the complex version above in a
//! fraction of the time. B. C. Carlson, Numerical Algorithms 10 (1995) 13; DLMF 19.36.
ERGO_HD double carlson_rf_real(double x, double y, double z) {
  constexpr int duplication_limit = 700;  // arguments that are 1e400 apart
  double mean = (x + y + z) / 3.0;
  for (int round = 0; round < duplication_limit; ++round) {
    const double spread = ::fmax(::fabs(x - mean), ::fmax(::fabs(y - mean), ::fabs(z - mean)));
    if (spread < 2e-3 * mean) {
      break;
    }
    const double rx = ::sqrt(x);
    const double ry = ::sqrt(y);
    const double rz = ::sqrt(z);
    const double lambda = rx * (ry + rz) + ry * rz;
    x = 0.25 * (x + lambda);
    y = 0.25 * (y + lambda);
    z = 0.25 * (z + lambda);
    mean = (x + y + z) / 3.0;
  }
  const double dx = (mean - x) / mean;
  const double dy = (mean - y) / mean;
  const double dz = -dx - dy;
  const double e2 = dx * dy - dz * dz;
  const double e3 = dx * dy * dz;
  const double series = 1.0 - e2 / 10.0 + e3 / 14.0 + e2 * e2 / 24.0 - e2 * e3 * 3.0 / 44.0 -
                        e2 * e2 * e2 * 5.0 / 208.0 + e3 * e3 * 3.0 / 104.0;
  return series / ::sqrt(mean);
}

}  // namespace ergodome::inline ERGO_TARGET
