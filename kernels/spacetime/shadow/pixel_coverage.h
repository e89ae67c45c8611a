#pragma once

#include "kernels/core/arithmetic.h"
#include "kernels/spacetime/shadow/edge_curve.h"

// Antialiasing of the shadow's edge.
namespace ergodome::inline ERGO_TARGET {

//! The fraction of a pixel that the sky lights, and the point in the pixel to trace.
struct PixelCoverage {
  float lit;      //!< fraction that the sky lights: 0 dark, 1 bright
  float shift_x;  //!< offset of the lit part's center from the pixel's center [px]
  float shift_y;
};

namespace detail {
//! Computes the coverage for a shadow smaller than one or two pixels. The shadow's area is
//! subtracted from the lit fractions of the pixels around its center, with weights that form a cone
//! of radius 1 px.
ERGO_HD PixelCoverage cover_by_speck(const EdgeCurve& edge, float alpha, float pixel_angle) {
  const float half_turn = 3.14159265F;
  const float radius_px = 0.5F * (edge.smallest + edge.largest) / pixel_angle;
  const float distance_px = alpha / pixel_angle;
  const float share = maximum(0.0F, 1.0F - distance_px) * 3.0F / half_turn;
  return {1.0F - minimum(1.0F, half_turn * radius_px * radius_px * share), 0.0F, 0.0F};
}
}  // namespace detail

//! Computes the coverage of the pixel whose center has direction `n` (observer's frame), with the
//! derivatives of n per pixel.
//!
//! The edge is taken as straight across a pixel, so the signed distance in pixels (the angle from
//! the edge divided by the length of its gradient) gives the lit fraction. The ray of a partly lit
//! pixel goes through the center of its lit part. So it never meets the shadow, and the color at
//! the edge is the sky's, not a blend of lit and lost rays.
ERGO_HD PixelCoverage cover_pixel(const EdgeCurve& edge, const Vector3<float>& n, const Vector3<float>& n_along_x,
                                  const Vector3<float>& n_along_y) {
  const float cosine = dot(n, edge.centre);
  const float px = dot(n, edge.first);
  const float py = dot(n, edge.second);
  const float sine = ::sqrtf(px * px + py * py);
  const float alpha = ::atan2f(sine, cosine);
  const float pixel_angle = ::sqrtf(maximum(dot(n_along_x, n_along_x), dot(n_along_y, n_along_y)));
  if (edge.largest < 1.5F * pixel_angle) {
    return detail::cover_by_speck(edge, alpha, pixel_angle);
  }
  if (!(sine > 0.0F)) {
    return {cosine < 0.0F ? 1.0F : 0.0F, 0.0F, 0.0F};
  }
  float edge_alpha = 0.0F;
  float slope = 0.0F;
  edge_at(edge, ::atan2f(py, px), edge_alpha, slope);
  // Unit vectors along α and γ.
  const Vector3<float> outwards = (1.0F / sine) * (cosine * n - edge.centre);
  const Vector3<float> around = (1.0F / sine) * (px * edge.second - py * edge.first);
  const auto gradient = [&](const Vector3<float>& step) {
    return dot(outwards, step) - slope * dot(around, step) / sine;
  };
  const float gx = gradient(n_along_x);
  const float gy = gradient(n_along_y);
  const float length = ::sqrtf(gx * gx + gy * gy);
  if (!(length > 0.0F)) {
    return {alpha > edge_alpha ? 1.0F : 0.0F, 0.0F, 0.0F};
  }
  const float distance_px = (alpha - edge_alpha) / length;
  if (distance_px >= 0.5F) {
    return {1.0F, 0.0F, 0.0F};
  }
  if (distance_px <= -0.5F) {
    return {0.0F, 0.0F, 0.0F};
  }
  const float shift = 0.5F * (0.5F - distance_px) / length;
  return {0.5F + distance_px, shift * gx, shift * gy};
}

}  // namespace ergodome::inline ERGO_TARGET
