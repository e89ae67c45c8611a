#pragma once

#include <cstdint>
#include <type_traits>

#include "kernels/core/host_device.h"

// SIMD packs for the CPU. Device code never includes this header: there a thread is a lane.
namespace ergodome::inline ERGO_TARGET {

//! Bytes of one SIMD register of the instruction set that this file is compiled for.
#if defined(__AVX512F__)
inline constexpr int register_bytes = 64;
#elif defined(__AVX2__)
inline constexpr int register_bytes = 32;
#else
inline constexpr int register_bytes = 16;
#endif

//! Truth value of each lane: all bits set, or none, in an integer as wide as the number it speaks of.
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
  Pack(T value) : lanes(Register{} + value) {}  // NOLINT(google-explicit-constructor): a number is a uniform pack
  explicit Pack(const Register& value) : lanes(value) {}
};

//! The widest pack of the instruction set this file is compiled for.
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

//! `yes` where the mask holds, `no` elsewhere.
template <class T, int N>
inline Pack<T, N> select(const PackMask<T, N>& mask, const Pack<T, N>& yes, const Pack<T, N>& no) {
  return Pack<T, N>(mask.bits ? yes.lanes : no.lanes);
}

template <class T, int N>
inline bool any(const PackMask<T, N>& mask) {
  typename PackMask<T, N>::Integer all = 0;
  for (int lane = 0; lane < N; ++lane) {
    all |= mask.bits[lane];
  }
  return all != 0;
}

template <class T, int N>
inline Pack<T, N> sqrt(const Pack<T, N>& a) {
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
  // Adding and taking away 1.5 * 2^mantissa leaves the nearest integer, for |a| far below 2^(mantissa - 1).
  const T magic = sizeof(T) == 4 ? T(12582912.0F) : T(6755399441055744.0);
  const Pack<T, N> shifted = a + Pack<T, N>(magic);
#if defined(__clang__)
  return shifted - Pack<T, N>(magic);
#else
  Pack<T, N> held = shifted;
  asm("" : "+v"(held.lanes));  // keeps the compiler from folding the pair away
  return held - Pack<T, N>(magic);
#endif
}

}  // namespace ergodome::inline ERGO_TARGET
