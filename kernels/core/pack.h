#pragma once

#include <cstdint>
#include <type_traits>

#include "kernels/core/host_device.h"

#if defined(__x86_64__)
#include <immintrin.h>
#endif

// SIMD packs for the CPU. Device code never includes this header: there each lane is a thread.
namespace ergodome::inline ERGO_TARGET {

//! Size of a SIMD register of the instruction set that this file is compiled for [bytes].
#if defined(__AVX512F__)
inline constexpr int register_bytes = 64;
#elif defined(__AVX2__)
inline constexpr int register_bytes = 32;
#else
inline constexpr int register_bytes = 16;
#endif

//! Mask of a pack. Each lane is an integer as wide as the numbers, with all bits set (true) or no
//! bit set (false).
template <class T, int N>
struct PackMask {
  using Integer = std::conditional_t<sizeof(T) == 4, std::int32_t, std::int64_t>;
  using Register __attribute__((vector_size(N * sizeof(T)))) = Integer;
  Register bits;
};

//! N numbers in one SIMD register; arithmetic acts on every lane.
template <class T, int N>
struct Pack {
  using Register __attribute__((vector_size(N * sizeof(T)))) = T;
  Register lanes;

  Pack() = default;
  // NOLINTNEXTLINE(google-explicit-constructor): a number becomes a pack with it in every lane
  Pack(T value) : lanes(Register{} + value) {}
  explicit Pack(const Register& value) : lanes(value) {}
};

//! The widest pack of the instruction set that this file is compiled for.
template <class T>
using WidePack = Pack<T, register_bytes / static_cast<int>(sizeof(T))>;

// clang-format off
template <class T, int N> inline Pack<T, N> operator+(const Pack<T, N>& a, const Pack<T, N>& b) { return Pack<T, N>(a.lanes + b.lanes); }
template <class T, int N> inline Pack<T, N> operator-(const Pack<T, N>& a, const Pack<T, N>& b) { return Pack<T, N>(a.lanes - b.lanes); }
template <class T, int N> inline Pack<T, N> operator*(const Pack<T, N>& a, const Pack<T, N>& b) { return Pack<T, N>(a.lanes * b.lanes); }
template <class T, int N> inline Pack<T, N> operator/(const Pack<T, N>& a, const Pack<T, N>& b) { return Pack<T, N>(a.lanes / b.lanes); }
template <class T, int N> inline Pack<T, N> operator-(const Pack<T, N>& a) { return Pack<T, N>(-a.lanes); }
template <class T, int N> inline Pack<T, N> operator+(const Pack<T, N>& a, T b) { return Pack<T, N>(a.lanes + b); }
template <class T, int N> inline Pack<T, N> operator-(const Pack<T, N>& a, T b) { return Pack<T, N>(a.lanes - b); }
template <class T, int N> inline Pack<T, N> operator*(const Pack<T, N>& a, T b) { return Pack<T, N>(a.lanes * b); }
template <class T, int N> inline Pack<T, N> operator/(const Pack<T, N>& a, T b) { return Pack<T, N>(a.lanes / b); }
template <class T, int N> inline Pack<T, N> operator+(T a, const Pack<T, N>& b) { return Pack<T, N>(a + b.lanes); }
template <class T, int N> inline Pack<T, N> operator-(T a, const Pack<T, N>& b) { return Pack<T, N>(a - b.lanes); }
template <class T, int N> inline Pack<T, N> operator*(T a, const Pack<T, N>& b) { return Pack<T, N>(a * b.lanes); }
template <class T, int N> inline Pack<T, N> operator/(T a, const Pack<T, N>& b) { return Pack<T, N>(a / b.lanes); }

template <class T, int N> inline PackMask<T, N> operator<(const Pack<T, N>& a, const Pack<T, N>& b) { return {a.lanes < b.lanes}; }
template <class T, int N> inline PackMask<T, N> operator<=(const Pack<T, N>& a, const Pack<T, N>& b) { return {a.lanes <= b.lanes}; }
template <class T, int N> inline PackMask<T, N> operator>(const Pack<T, N>& a, const Pack<T, N>& b) { return {a.lanes > b.lanes}; }
template <class T, int N> inline PackMask<T, N> operator>=(const Pack<T, N>& a, const Pack<T, N>& b) { return {a.lanes >= b.lanes}; }
template <class T, int N> inline PackMask<T, N> operator<(const Pack<T, N>& a, T b) { return a < Pack<T, N>(b); }
template <class T, int N> inline PackMask<T, N> operator<=(const Pack<T, N>& a, T b) { return a <= Pack<T, N>(b); }
template <class T, int N> inline PackMask<T, N> operator>(const Pack<T, N>& a, T b) { return a > Pack<T, N>(b); }
template <class T, int N> inline PackMask<T, N> operator>=(const Pack<T, N>& a, T b) { return a >= Pack<T, N>(b); }
template <class T, int N> inline PackMask<T, N> operator&(const PackMask<T, N>& a, const PackMask<T, N>& b) { return {a.bits & b.bits}; }
template <class T, int N> inline PackMask<T, N> operator|(const PackMask<T, N>& a, const PackMask<T, N>& b) { return {a.bits | b.bits}; }
template <class T, int N> inline PackMask<T, N> operator!(const PackMask<T, N>& a) { return {~a.bits}; }
// clang-format on

//! Returns `yes` in lanes where the mask is set, `no` in the others.
template <class T, int N>
inline Pack<T, N> select(const PackMask<T, N>& mask, const Pack<T, N>& yes, const Pack<T, N>& no) {
  return Pack<T, N>(mask.bits ? yes.lanes : no.lanes);
}

//! Returns an integer whose bit i is lane i of the mask.
template <class T, int N>
inline unsigned mask_bits(const PackMask<T, N>& mask) {
  unsigned bits = 0;
#if defined(__x86_64__)
  // Uses intrinsics, because compilers do not generate these instructions from the loop below.
  if constexpr (N * sizeof(T) == register_bytes) {
#if defined(__AVX512DQ__)
    const auto whole = reinterpret_cast<__m512i>(mask.bits);
    return sizeof(T) == 4 ? static_cast<unsigned>(_mm512_movepi32_mask(whole))
                          : static_cast<unsigned>(_mm512_movepi64_mask(whole));
#elif defined(__AVX2__)
    return static_cast<unsigned>(sizeof(T) == 4 ? _mm256_movemask_ps(reinterpret_cast<__m256>(mask.bits))
                                                : _mm256_movemask_pd(reinterpret_cast<__m256d>(mask.bits)));
#else
    return static_cast<unsigned>(sizeof(T) == 4 ? _mm_movemask_ps(reinterpret_cast<__m128>(mask.bits))
                                                : _mm_movemask_pd(reinterpret_cast<__m128d>(mask.bits)));
#endif
  }
#endif
  for (int lane = 0; lane < N; ++lane) {
    bits |= mask.bits[lane] != 0 ? 1U << lane : 0U;
  }
  return bits;
}

template <class T, int N>
inline bool any(const PackMask<T, N>& mask) {
  return mask_bits(mask) != 0;
}

// Compilers would call a function for this single instruction, because they count the steps of the loop.
template <class T, int N>
[[gnu::always_inline]] inline Pack<T, N> sqrt(const Pack<T, N>& a) {
  Pack<T, N> root;
  for (int lane = 0; lane < N; ++lane) {
    if constexpr (sizeof(T) == 4) {
      root.lanes[lane] = __builtin_sqrtf(a.lanes[lane]);
    } else {
      root.lanes[lane] = __builtin_sqrt(a.lanes[lane]);
    }
  }
  return root;
}

template <class T, int N>
inline Pack<T, N> round_to_nearest(const Pack<T, N>& a) {
  // Adding and subtracting 1.5 * 2^mantissa leaves the nearest integer, for |a| far below
  // 2^(mantissa - 1).
  const T magic = sizeof(T) == 4 ? T(12582912.0F) : T(6755399441055744.0);
  const Pack<T, N> shifted = a + Pack<T, N>(magic);
#if defined(__clang__)
  return shifted - Pack<T, N>(magic);
#else
  Pack<T, N> held = shifted;
  asm("" : "+v"(held.lanes));  // prevents the compiler from folding the pair
  return held - Pack<T, N>(magic);
#endif
}

}  // namespace ergodome::inline ERGO_TARGET
