#pragma once

#include <cstdint>
#include <cstring>

#include "kernels/sky/cube_map.h"

namespace ergodome::inline ERGO_TARGET {

namespace detail {

//! log2 of a positive number to 0.01: what choosing between mip levels takes.
ERGO_HD float rough_log2(float a) {
  std::int32_t bits = 0;
  std::memcpy(&bits, &a, sizeof bits);
  const std::int32_t exponent = bits >> 23;
  const std::int32_t mantissa_bits = (bits & 0x007fffff) | 0x3f800000;
  float m = 0.0F;
  std::memcpy(&m, &mantissa_bits, sizeof m);
  return static_cast<float>(exponent - 128) + (-0.33333333F * m + 2.0F) * m - 0.66666667F;
}

//! The two levels between which a round footprint lies, and how far towards the coarser one.
struct CubeLevel {
  int fine;
  float part;
};

ERGO_HD CubeLevel cube_level(const CubeMap& map, float radius) {
  const float level = maximum(rough_log2(maximum(2.0F * radius / cube_texel_angle(map), 1.0F)), 0.0F);
  const float last = static_cast<float>(map.level_count - 1);
  const int fine = static_cast<int>(minimum(level, last));
  return {fine, fine + 1 < map.level_count ? level - static_cast<float>(fine) : 0.0F};
}

//! Trilinear look-up of a round footprint.
ERGO_HD Quad cube_trilinear(const CubeMap& map, const Vector3<float>& d, const CubeLevel& level) {
  const CubePlace place = cube_place(d);
  const Quad fine = cube_bilinear(map, level.fine, place);
  if (!(level.part > 0.0F)) {
    return fine;
  }
  return (1.0F - level.part) * fine + level.part * cube_bilinear(map, level.fine + 1, place);
}

//! exp(-2 (i / n)²): weights of the probes on one side, out to two standard deviations.
ERGO_HD float probe_weight(int i, int n) {
  const float part = static_cast<float>(i) / static_cast<float>(n);
  // e^x for x from -2 to 0 as the eighth power of a quartic.
  const float x = -0.25F * part * part;
  const float e = 1.0F + x * (1.0F + x * (0.5F + x * (0.16666667F + x * 0.041666667F)));
  const float e2 = e * e;
  const float e4 = e2 * e2;
  return e4 * e4;
}

ERGO_HD Vector3<float> rgb_of(const Quad& q) { return {quad_part(q, 0), quad_part(q, 1), quad_part(q, 2)}; }

//! Half axes of the ellipse onto which a pixel of unit radius falls: major axis as a vector, minor axis as a length.
struct Ellipse {
  Vector3<float> major;
  float major_length;
  float minor_length;
};

//! The ellipse of the map (cos t, sin t) -> cos t a + sin t b, from the eigenvalues of its 2 x 2 Gram matrix.
ERGO_HD Ellipse ellipse_of(const Vector3<float>& a, const Vector3<float>& b) {
  const float aa = dot(a, a);
  const float bb = dot(b, b);
  const float ab = dot(a, b);
  const float half_sum = 0.5F * (aa + bb);
  const float half_difference = 0.5F * (aa - bb);
  const float root = ::sqrtf(half_difference * half_difference + ab * ab);
  const float largest = half_sum + root;
  // The product of the eigenvalues is |a x b|²: no cancellation for thin ellipses.
  const Vector3<float> area = cross(a, b);
  const float smallest = largest > 0.0F ? dot(area, area) / largest : 0.0F;
  const float c = half_difference + root;
  const Vector3<float> axis = half_difference >= 0.0F ? c * a + ab * b : ab * a + (root - half_difference) * b;
  const float length2 = dot(axis, axis);
  const float major = ::sqrtf(largest);
  const Vector3<float> direction = length2 > 0.0F ? (major / ::sqrtf(length2)) * axis : a;
  return {direction, major, ::sqrtf(smallest)};
}

}  // namespace detail

//! Probes along the major axis at the most; longer ellipses are widened instead.
inline constexpr int probe_limit = 12;

//! Light of the sky over the footprint of one pixel: an elliptic Gaussian, as round probes along its major axis.
//!
//! `direction` is a unit vector, `along_x` and `along_y` its derivatives per pixel. The probes are as wide as the minor axis and lie on
//! a great circle, so they cross faces and poles like any other place (after Feline: McCormack, Perry, Farkas & Jouppi, SIGGRAPH
//! 1999; EWA: Heckbert 1989). A footprint as wide as the sky, or one that is not a number, sees the mean of the sky. Weights add up
//! to 1: a constant sky stays constant.
ERGO_HD Vector3<float> filter_sky(const CubeMap& map, const Vector3<float>& direction, const Vector3<float>& along_x,
                                  const Vector3<float>& along_y) {
  // A pixel as a Gaussian of standard deviation 0.5 px: its probes reach half a pixel to either side.
  detail::Ellipse ellipse = detail::ellipse_of(0.5F * along_x, 0.5F * along_y);
  if (!(ellipse.major_length < 1.0F)) {
    return cube_mean(map);
  }
  const float texel = cube_texel_angle(map);
  const float minor = maximum(ellipse.minor_length, 0.5F * texel);
  const float ratio = ellipse.major_length / minor;
  if (ratio <= 1.3F) {
    return detail::rgb_of(detail::cube_trilinear(map, direction, detail::cube_level(map, minor)));
  }
  // Probes out to two standard deviations of the footprint. A texel of their level is two minor axes wide, and bilinear look-ups a
  // texel apart add up evenly: less than that is close enough.
  constexpr int most = probe_limit / 2;
  const float wanted = 1.25F * ratio;
  const int half_count = wanted < static_cast<float>(most) ? static_cast<int>(wanted) + 1 : most;
  const float spacing = 2.0F * ellipse.major_length / static_cast<float>(half_count);
  const detail::CubeLevel level = detail::cube_level(map, maximum(minor, 0.5F * spacing));
  const Vector3<float> unit = (1.0F / ellipse.major_length) * ellipse.major;
  // One turn by the spacing, again and again.
  float sine_step = 0.0F;
  float cosine_step = 1.0F;
  sine_cosine(spacing, sine_step, cosine_step);
  float sine = 0.0F;
  float cosine = 1.0F;
  Quad sum = detail::cube_trilinear(map, direction, level);
  float weights = 1.0F;
  for (int i = 1; i <= half_count; ++i) {
    const float weight = detail::probe_weight(i, half_count);
    const float next_sine = sine * cosine_step + cosine * sine_step;
    cosine = cosine * cosine_step - sine * sine_step;
    sine = next_sine;
    const Vector3<float> ahead = cosine * direction + sine * unit;
    const Vector3<float> behind = cosine * direction - sine * unit;
    sum = sum + weight * (detail::cube_trilinear(map, ahead, level) + detail::cube_trilinear(map, behind, level));
    weights += 2.0F * weight;
  }
  return (1.0F / weights) * detail::rgb_of(sum);
}

}  // namespace ergodome::inline ERGO_TARGET
