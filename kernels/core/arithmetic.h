#pragma once

#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <type_traits>

#include "kernels/core/host_device.h"
#if !defined(__CUDACC__)
#include "kernels/core/pack.h"
#endif

// The elementary operations of kernels on "a real number": a plain number, a SIMD pack of numbers,
// or a dual number (added by kernels/core/dual.h).
namespace ergodome::inline ERGO_TARGET {

//! Types that belong to a real type (a plain number, a pack or a dual number): `Scalar` is the
//! number type of one lane (float or double), `Real` the type without derivatives, `Mask` the
//! result of a comparison, and `Integer` one integer per lane, as wide as Scalar (dual numbers have
//! none). `lane_count` is the number of lanes.
template <class T>
struct RealTraits {
  using Scalar = T;
  using Real = T;
  using Mask = bool;
  using Integer = std::conditional_t<sizeof(T) == 4, std::int32_t, std::int64_t>;
  static constexpr int lane_count = 1;
};

//! True for types that carry a mixed second derivative (MixedDual in kernels/core/dual.h).
template <class T>
inline constexpr bool has_mixed_part = false;

template <class T>
using ScalarOf = typename RealTraits<T>::Scalar;
template <class T>
using RealOf = typename RealTraits<T>::Real;
template <class T>
using MaskOf = typename RealTraits<T>::Mask;
template <class T>
using IntegerOf = typename RealTraits<T>::Integer;

// clang-format off
ERGO_HD float select(bool mask, float yes, float no) { return mask ? yes : no; }
ERGO_HD double select(bool mask, double yes, double no) { return mask ? yes : no; }
ERGO_HD bool any(bool mask) { return mask; }
ERGO_HD float sqrt(float a) { return ::sqrtf(a); }
ERGO_HD double sqrt(double a) { return ::sqrt(a); }
ERGO_HD float round_to_nearest(float a) { return ::rintf(a); }
ERGO_HD double round_to_nearest(double a) { return ::rint(a); }
ERGO_HD float value_of(float a) { return a; }
ERGO_HD double value_of(double a) { return a; }
ERGO_HD float lane(float a, int) { return a; }
ERGO_HD double lane(double a, int) { return a; }
ERGO_HD void set_lane(float& a, int, float value) { a = value; }
ERGO_HD void set_lane(double& a, int, double value) { a = value; }
ERGO_HD bool mask_lane(bool mask, int) { return mask; }
ERGO_HD unsigned mask_bits(bool mask) { return mask ? 1U : 0U; }
ERGO_HD std::int32_t truncated(float a) { return static_cast<std::int32_t>(a); }
// clang-format on

//! Returns the position of the lowest bit that is set; `bits` must not be 0. nvcc 13 compiles
//! std::countr_zero to the constant 32.
ERGO_HD int lowest_bit(unsigned bits) {
#if defined(__CUDA_ARCH__)
  return __ffs(static_cast<int>(bits)) - 1;
#else
  return std::countr_zero(bits);
#endif
}

#if !defined(__CUDACC__)
template <class T, int N>
struct RealTraits<Pack<T, N>> {
  using Scalar = T;
  using Real = Pack<T, N>;
  using Mask = PackMask<T, N>;
  using Integer = typename PackMask<T, N>::Register;
  static constexpr int lane_count = N;
};

// clang-format off
template <class T, int N> inline Pack<T, N> value_of(const Pack<T, N>& a) { return a; }
template <class T, int N> inline T lane(const Pack<T, N>& a, int i) { return a.lanes[i]; }
template <class T, int N> inline void set_lane(Pack<T, N>& a, int i, T value) { a.lanes[i] = value; }
template <class T, int N> inline bool mask_lane(const PackMask<T, N>& mask, int i) { return mask.bits[i] != 0; }
template <int N> inline auto truncated(const Pack<float, N>& a) { return __builtin_convertvector(a.lanes, typename PackMask<float, N>::Register); }
// clang-format on
#endif

//! Converts integers to real numbers.
template <class T>
ERGO_HD T real_of(const IntegerOf<T>& a) {
  if constexpr (RealTraits<T>::lane_count == 1) {
    return static_cast<T>(a);
  } else {
    return T(__builtin_convertvector(a, typename T::Register));
  }
}

template <class T>
ERGO_HD T minimum(const T& a, const T& b) {
  return select(a < b, a, b);
}

template <class T>
ERGO_HD T maximum(const T& a, const T& b) {
  return select(a > b, a, b);
}

template <class T>
ERGO_HD T absolute(const T& a) {
  return select(a < T(ScalarOf<T>(0)), -a, a);
}

//! Returns sqrt(a), or 0 if a is negative or NaN: rounding may make a square slightly negative.
template <class T>
ERGO_HD T safe_sqrt(const T& a) {
  return sqrt(select(a > T(ScalarOf<T>(0)), a, T(ScalarOf<T>(0))));
}

//! Returns a^p to about 4 %, enough for a step size, for 0 < p < 1 and an a > 0 that is not
//! subnormal.
//!
//! Uses the exponent bits as a piecewise linear logarithm.
ERGO_HD float rough_power(float a, float p) {
  std::int32_t bits = 0;
  std::memcpy(&bits, &a, sizeof bits);
  const float logarithm = static_cast<float>(bits - 0x3f7a3bea);
  bits = static_cast<std::int32_t>(p * logarithm) + 0x3f7a3bea;
  float power = 0;
  std::memcpy(&power, &bits, sizeof power);
  return power;
}

ERGO_HD double rough_power(double a, double p) {
  std::int64_t bits = 0;
  std::memcpy(&bits, &a, sizeof bits);
  const double logarithm = static_cast<double>(bits - 0x3fef477d30000000LL);
  bits = static_cast<std::int64_t>(p * logarithm) + 0x3fef477d30000000LL;
  double power = 0;
  std::memcpy(&power, &bits, sizeof power);
  return power;
}

//! Returns log2 of a positive number to 0.01, enough to choose between mip levels.
ERGO_HD float rough_log2(float a) {
  std::int32_t bits = 0;
  std::memcpy(&bits, &a, sizeof bits);
  const std::int32_t exponent = bits >> 23;
  const std::int32_t mantissa_bits = (bits & 0x007fffff) | 0x3f800000;
  float m = 0.0F;
  std::memcpy(&m, &mantissa_bits, sizeof m);
  return static_cast<float>(exponent - 128) + (-0.33333333F * m + 2.0F) * m - 0.66666667F;
}

#if !defined(__CUDACC__)
template <int N>
inline Pack<float, N> rough_log2(const Pack<float, N>& a) {
  using Integer = typename PackMask<float, N>::Register;
  using Register = typename Pack<float, N>::Register;
  const Integer bits = (Integer)a.lanes;
  const Pack<float, N> exponent(__builtin_convertvector((bits >> 23) - 128, Register));
  const Pack<float, N> m((Register)((bits & 0x007fffff) | 0x3f800000));
  return exponent + (m * -0.33333333F + 2.0F) * m - 0.66666667F;
}

template <class T, int N>
inline Pack<T, N> rough_power(const Pack<T, N>& a, T p) {
  // Casts between vector types of the same size keep the bits.
  using Integer = typename PackMask<T, N>::Register;
  using Register = typename Pack<T, N>::Register;
  const auto one = static_cast<typename PackMask<T, N>::Integer>(sizeof(T) == 4 ? 0x3f7a3beaLL : 0x3fef477d30000000LL);
  const Integer bits = (Integer)a.lanes - one;
  const Integer power = __builtin_convertvector(p * __builtin_convertvector(bits, Register), Integer) + one;
  return Pack<T, N>((Register)power);
}
#endif

namespace detail {
//! Computes sin and cos on [-π/4, π/4]; coefficients of the Cephes library (S. Moshier), float and
//! double.
template <class T>
ERGO_HD void sine_cosine_octant(const T& x, T& sine, T& cosine) {
  using S = ScalarOf<T>;
  const T z = x * x;
  if constexpr (sizeof(S) == 4) {
    sine = x + x * z * (S(-1.6666654611e-1) + z * (S(8.3321608736e-3) + z * S(-1.9515295891e-4)));
    cosine = S(1) - S(0.5) * z +
             z * z * (S(4.166664568298827e-2) + z * (S(-1.388731625493765e-3) + z * S(2.443315711809948e-5)));
  } else {
    sine = x + x * z *
                   (S(-1.66666666666666307295e-1) +
                    z * (S(8.33333333332211858878e-3) +
                         z * (S(-1.98412698295895385996e-4) +
                              z * (S(2.75573136213857245213e-6) +
                                   z * (S(-2.50507477628578072866e-8) + z * S(1.58962301576546568060e-10))))));
    cosine = S(1) - S(0.5) * z +
             z * z *
                 (S(4.16666666666665929218e-2) +
                  z * (S(-1.38888888888730564116e-3) +
                       z * (S(2.48015872888517045348e-5) +
                            z * (S(-2.75573141792967388112e-7) +
                                 z * (S(2.08757008419747316778e-9) + z * S(-1.13585365213876817300e-11))))));
  }
}
}  // namespace detail

//! Computes sin and cos of an angle of moderate size (|angle| < 10⁴), to a few units in the last
//! place.
template <class T>
ERGO_HD void sine_cosine(const T& angle, T& sine, T& cosine) {
  using S = ScalarOf<T>;
  // Cody and Waite: the angle minus the nearest multiple of π/2, with π/2 in three parts.
  const T quadrant = round_to_nearest(angle * S(0.63661977236758134308));
  T rest = angle;
  if constexpr (sizeof(S) == 4) {
    rest = ((rest - quadrant * S(1.5703125)) - quadrant * S(4.837512969970703e-4)) - quadrant * S(7.549789948768648e-8);
  } else {
    rest = ((rest - quadrant * S(1.57079625129699707031)) - quadrant * S(7.54978941586159635335e-8)) -
           quadrant * S(5.39030252995776476554e-15);
  }
  T s;
  T c;
  detail::sine_cosine_octant(rest, s, c);
  // Computes quadrant mod 4 (0, 1, 2 or 3) by rounding, which works for plain numbers and packs
  // alike; integer arithmetic does not.
  const T turn = quadrant - S(4) * round_to_nearest(quadrant * S(0.25) - S(0.375));
  const auto odd = absolute(turn - S(2) * round_to_nearest(turn * S(0.5) - S(0.25))) > S(0.5);
  const auto sine_negative = turn > S(1.5);
  const auto cosine_negative = (turn > S(0.5)) & (turn < S(2.5));
  const T sine_size = select(odd, c, s);
  const T cosine_size = select(odd, s, c);
  sine = select(sine_negative, -sine_size, sine_size);
  cosine = select(cosine_negative, -cosine_size, cosine_size);
}

}  // namespace ergodome::inline ERGO_TARGET
