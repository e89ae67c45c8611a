#pragma once

#include "kernels/sky/cube_map.h"

namespace ergodome::inline ERGO_TARGET {

namespace detail {

//! Trilinear look-up of a round footprint of the given radius [rad].
ERGO_HD Vector3<float> cube_trilinear(const CubeMap& map, const Vector3<float>& d, float radius) {
  const CubePlace place = cube_place(d);
  const float level = ::fmaxf(::log2f(::fmaxf(2.0F * radius / cube_texel_angle(map), 1e-6F)), 0.0F);
  const float last = static_cast<float>(map.level_count - 1);
  const int below = static_cast<int>(::fminf(level, last));
  const Vector3<float> fine = cube_bilinear(map, below, place);
  const float part = level - static_cast<float>(below);
  if (below + 1 >= map.level_count) {
    return fine;
  }
  return fine + part * (cube_bilinear(map, below + 1, place) - fine);
}

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
  const float minor = ::fmaxf(ellipse.minor_length, 0.5F * texel);
  const float ratio = ellipse.major_length / minor;
  if (ratio <= 1.3F) {
    return detail::cube_trilinear(map, direction, minor);
  }
  // Probes one minor axis apart, out to two standard deviations of the footprint.
  const int wanted = static_cast<int>(::ceilf(2.0F * ratio));
  const int half_count = wanted < probe_limit / 2 ? wanted : probe_limit / 2;
  const float spacing = 2.0F * ellipse.major_length / static_cast<float>(half_count);
  const float radius = ::fmaxf(minor, 0.6F * spacing);
  const Vector3<float> unit = (1.0F / ellipse.major_length) * ellipse.major;
  Vector3<float> sum = detail::cube_trilinear(map, direction, radius);
  float weights = 1.0F;
  for (int i = 1; i <= half_count; ++i) {
    const float angle = spacing * static_cast<float>(i);
    const float deviations = angle / ellipse.major_length;
    const float weight = ::expf(-0.5F * deviations * deviations);
    const float sine = ::sinf(angle);
    const float cosine = ::cosf(angle);
    const Vector3<float> ahead = cosine * direction + sine * unit;
    const Vector3<float> behind = cosine * direction - sine * unit;
    sum = sum + weight * (detail::cube_trilinear(map, ahead, radius) + detail::cube_trilinear(map, behind, radius));
    weights += 2.0F * weight;
  }
  return (1.0F / weights) * sum;
}

}  // namespace ergodome::inline ERGO_TARGET
