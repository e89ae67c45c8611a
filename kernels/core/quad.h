#pragma once

#include <cstdint>
#include <cstring>

#include "kernels/core/host_device.h"
#if defined(__F16C__) && !defined(__CUDACC__)
#include <immintrin.h>
#endif

// Four floats that are loaded, weighted and added together: a texel, or four of the floats in a
// grid's node. Pointers that are loaded from or stored to must be 16-byte aligned.
namespace ergodome {

//! A quad in half the memory: four IEEE half floats, 8-byte aligned.
struct alignas(8) HalfQuad {
  std::uint16_t part[4];
};

inline namespace ERGO_TARGET {

#if defined(__CUDACC__)
struct Quad {
  float4 part;
};

ERGO_HD Quad load_quad(const float* from) { return {*reinterpret_cast<const float4*>(from)}; }
ERGO_HD void store_quad(float* to, const Quad& q) { *reinterpret_cast<float4*>(to) = q.part; }
ERGO_HD Quad quad_of(float a) { return {make_float4(a, a, a, a)}; }
ERGO_HD Quad quad_from(float a, float b, float c, float d) { return {make_float4(a, b, c, d)}; }
ERGO_HD float quad_part(const Quad& q, int i) {
  return i == 0 ? q.part.x : (i == 1 ? q.part.y : (i == 2 ? q.part.z : q.part.w));
}
ERGO_HD Quad operator+(const Quad& a, const Quad& b) {
  return {make_float4(a.part.x + b.part.x, a.part.y + b.part.y, a.part.z + b.part.z, a.part.w + b.part.w)};
}
ERGO_HD Quad operator*(float s, const Quad& a) {
  return {make_float4(s * a.part.x, s * a.part.y, s * a.part.z, s * a.part.w)};
}
#else
struct Quad {
  using Register __attribute__((vector_size(16))) = float;
  Register part;
};

ERGO_HD Quad load_quad(const float* from) { return {*reinterpret_cast<const Quad::Register*>(from)}; }
ERGO_HD void store_quad(float* to, const Quad& q) { *reinterpret_cast<Quad::Register*>(to) = q.part; }
ERGO_HD Quad quad_of(float a) { return {Quad::Register{a, a, a, a}}; }
ERGO_HD Quad quad_from(float a, float b, float c, float d) { return {Quad::Register{a, b, c, d}}; }
ERGO_HD float quad_part(const Quad& q, int i) { return q.part[i]; }
ERGO_HD Quad operator+(const Quad& a, const Quad& b) { return {a.part + b.part}; }
ERGO_HD Quad operator*(float s, const Quad& a) { return {s * a.part}; }
#endif

//! Returns the value of a finite IEEE half float.
ERGO_HD float half_value(std::uint16_t half) {
  float value = 0.0F;
#if defined(__CUDA_ARCH__)
  asm("cvt.f32.f16 %0, %1;" : "=f"(value) : "h"(half));
#else
  // After the shift, only the bias of the exponent differs, by 112.
  const std::uint32_t bits = (half & 0x7fffU) << 13U;
  std::memcpy(&value, &bits, sizeof value);
  value *= (half & 0x8000U) != 0 ? -0x1p112F : 0x1p112F;
#endif
  return value;
}

ERGO_HD Quad load_quad(const HalfQuad* from) {
#if defined(__F16C__) && !defined(__CUDACC__)
  return {static_cast<Quad::Register>(_mm_cvtph_ps(_mm_loadl_epi64(reinterpret_cast<const __m128i*>(from))))};
#else
  const HalfQuad half = *from;
  return quad_from(half_value(half.part[0]), half_value(half.part[1]), half_value(half.part[2]),
                   half_value(half.part[3]));
#endif
}

}  // namespace ERGO_TARGET
}  // namespace ergodome
