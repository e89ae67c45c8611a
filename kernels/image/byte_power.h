#pragma once

#include <cstdint>
#include <cstring>

#include "kernels/core/arithmetic.h"

// Computes round(255 a^p), accurate to 0.01 before rounding. Uses polynomials for log2(1 + t) / t
// and (2^t - 1) / t, fitted by reweighted least squares with nearly even errors, such that 1 yields
// 255. `T` is a number or a pack.
namespace ergodome::inline ERGO_TARGET::detail {

//! Bits of √½, by which a is split: a = m 2^e with m in [√½, √2).
inline constexpr std::int32_t root_of_half_bits = 0x3f3504f3;
inline constexpr std::int32_t mantissa_bits = 0x007fffff;

//! Returns log2(2^e (1 + t)).
template <class T>
ERGO_HD T binary_logarithm(const T& t, const T& e) {
  const T bend = ((0.25265691F * t - 0.39457493F) * t + 0.48668662F) * t - 0.72024182F;
  return bend * (t * t) + (1.44257800F * t + e);
}

//! Returns 255 * 2^x for x in [-½, ½].
template <class T>
ERGO_HD T scaled_power_of_two(const T& x) {
  return (((2.46877094F * x + 14.2595662F) * x + 61.2561791F) * x + 176.745980F) * x + 255.0F;
}

//! Returns round(255 a^p) for a in [2^-100, 1] and p in (0, 1], or for larger p where a^p is at
//! least 2^-100.
ERGO_HD std::uint32_t eight_bit_power(float a, float p) {
  std::int32_t bits = 0;
  std::memcpy(&bits, &a, sizeof bits);
  bits -= root_of_half_bits;
  const std::int32_t m_bits = (bits & mantissa_bits) + root_of_half_bits;
  float m = 0.0F;
  std::memcpy(&m, &m_bits, sizeof m);
  const float power = binary_logarithm(m - 1.0F, static_cast<float>(bits >> 23)) * p;
  const float whole = round_to_nearest(power);
  const float scaled = scaled_power_of_two(power - whole);
  std::int32_t value_bits = 0;
  std::memcpy(&value_bits, &scaled, sizeof value_bits);
  value_bits += static_cast<std::int32_t>(whole) * (mantissa_bits + 1);
  float value = 0.0F;
  std::memcpy(&value, &value_bits, sizeof value);
  return static_cast<std::uint32_t>(round_to_nearest(value));
}

}  // namespace ergodome::inline ERGO_TARGET::detail
