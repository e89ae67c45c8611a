#pragma once

#include "kernels/core/arithmetic.h"

// Exponential, logarithm and arctangent of a real number: library functions for plain numbers and
// doubles, polynomials for packs of floats (coefficients of the Cephes library, S. Moshier; a few
// units in the last place).
namespace ergodome::inline ERGO_TARGET {

// clang-format off
ERGO_HD float natural_logarithm(float a) { return ::logf(a); }
ERGO_HD double natural_logarithm(double a) { return ::log(a); }
ERGO_HD float exponential(float a) { return ::expf(a); }
ERGO_HD double exponential(double a) { return ::exp(a); }
ERGO_HD float arc_tangent(float y, float x) { return ::atan2f(y, x); }
ERGO_HD double arc_tangent(double y, double x) { return ::atan2(y, x); }
// clang-format on

#if !defined(__CUDACC__)
namespace detail {
template <class T, int N, class Function>
inline Pack<T, N> lane_by_lane(const Pack<T, N>& a, const Function& function) {
  Pack<T, N> result;
  for (int i = 0; i < N; ++i) {
    result.lanes[i] = function(a.lanes[i]);
  }
  return result;
}

//! Returns arctan on [0, 1].
template <int N>
inline Pack<float, N> arc_tangent_unit(const Pack<float, N>& a) {
  const auto steep = a > 0.4142135623730950F;
  const Pack<float, N> x = select(steep, (a - 1.0F) / (a + 1.0F), a);
  const Pack<float, N> z = x * x;
  const Pack<float, N> p =
      (((8.05374449538e-2F * z - 1.38776856032e-1F) * z + 1.99777106478e-1F) * z - 3.33329491539e-1F) * z * x + x;
  return select(steep, p + 0.785398163397448F, p);
}
}  // namespace detail

//! Returns ln a for a > 0, not subnormal.
template <class T, int N>
inline Pack<T, N> natural_logarithm(const Pack<T, N>& a) {
  if constexpr (sizeof(T) == 8) {
    return detail::lane_by_lane(a, [](T x) { return ::log(x); });
  } else {
    using Integer = typename PackMask<T, N>::Register;
    using Register = typename Pack<T, N>::Register;
    // a = m 2^e with m in [√½, √2): casts between vector types of one size keep the bits.
    const Integer bits = (Integer)a.lanes - 0x3f3504f3;
    const Pack<T, N> e(__builtin_convertvector(bits >> 23, Register));
    const Pack<T, N> x = Pack<T, N>((Register)((bits & 0x007fffff) + 0x3f3504f3)) - 1.0F;
    const Pack<T, N> z = x * x;
    Pack<T, N> p = 7.0376836292e-2F * x - 1.1514610310e-1F;
    p = p * x + 1.1676998740e-1F;
    p = p * x - 1.2420140846e-1F;
    p = p * x + 1.4249322787e-1F;
    p = p * x - 1.6668057665e-1F;
    p = p * x + 2.0000714765e-1F;
    p = p * x - 2.4999993993e-1F;
    p = p * x + 3.3333331174e-1F;
    return e * 0.693359375F + (x + (p * x * z - 0.5F * z - e * 2.12194440e-4F));
  }
}

//! Returns e^a for |a| < 87.
template <class T, int N>
inline Pack<T, N> exponential(const Pack<T, N>& a) {
  if constexpr (sizeof(T) == 8) {
    return detail::lane_by_lane(a, [](T x) { return ::exp(x); });
  } else {
    using Integer = typename PackMask<T, N>::Register;
    using Register = typename Pack<T, N>::Register;
    const Pack<T, N> n = round_to_nearest(a * 1.44269504088896341F);
    const Pack<T, N> x = (a - n * 0.693359375F) + n * 2.12194440e-4F;
    Pack<T, N> p = 1.9875691500e-4F * x + 1.3981999507e-3F;
    p = p * x + 8.3334519073e-3F;
    p = p * x + 4.1665795894e-2F;
    p = p * x + 1.6666665459e-1F;
    p = p * x + 5.0000001201e-1F;
    const Pack<T, N> mantissa = p * x * x + x + 1.0F;
    const Integer scale = (__builtin_convertvector(n.lanes, Integer) + 127) << 23;
    return mantissa * Pack<T, N>((Register)scale);
  }
}

//! Returns the angle of the point (x, y), from -π to π; 0 at the origin.
template <class T, int N>
inline Pack<T, N> arc_tangent(const Pack<T, N>& y, const Pack<T, N>& x) {
  if constexpr (sizeof(T) == 8) {
    Pack<T, N> result;
    for (int i = 0; i < N; ++i) {
      result.lanes[i] = ::atan2(y.lanes[i], x.lanes[i]);
    }
    return result;
  } else {
    const Pack<T, N> ax = absolute(x);
    const Pack<T, N> ay = absolute(y);
    const auto steep = ay > ax;
    const Pack<T, N> large = maximum(select(steep, ay, ax), Pack<T, N>(1e-37F));
    const Pack<T, N> first = detail::arc_tangent_unit(select(steep, ax, ay) / large);
    const Pack<T, N> quarter = select(steep, 1.57079632679489662F - first, first);
    const Pack<T, N> half = select(x < T(0), 3.14159265358979324F - quarter, quarter);
    return select(y < T(0), -half, half);
  }
}
#endif

}  // namespace ergodome::inline ERGO_TARGET
