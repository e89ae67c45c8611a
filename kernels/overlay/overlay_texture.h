#pragma once

#include <cstdint>

#include "kernels/core/arithmetic.h"
#include "kernels/core/quad.h"

// Images that are drawn over a picture: linear light of a display, where 1 is its maximum,
// multiplied by alpha; with levels of halved size down to one texel.
namespace ergodome {

inline constexpr int overlay_level_limit = 15;

//! A texture as kernels read it: four integers per texel (red, green, blue, alpha), 65535 for 1.
//! The first row is the top.
struct OverlayTexture {
  const std::uint16_t* texels;
  long level_offset[overlay_level_limit];  //!< first texel of each level
  int width;                               //!< width of level 0; level k has width >> k, at least 1
  int height;
  int level_count;
};

//! A pixel's footprint on a texture: its middle, 0 to 1 from the left and from the top, and the
//! derivatives per pixel.
struct OverlayFootprint {
  float s, t;
  float s_along_x, s_along_y;
  float t_along_x, t_along_y;
};

inline namespace ERGO_TARGET {

namespace detail {
ERGO_HD Quad overlay_texel(const std::uint16_t* texels, int width, int column, int row) {
  const std::uint16_t* at = texels + 4 * (static_cast<long>(row) * width + column);
  alignas(16) float part[4];
  for (int i = 0; i < 4; ++i) {
    part[i] = static_cast<float>(at[i]);
  }
  return load_quad(part);
}

//! Interpolates the four texels about a position of a level; clamps at the sides. In units of 1 /
//! 65535.
ERGO_HD Quad overlay_between(const OverlayTexture& texture, int level, float s, float t) {
  const int width = texture.width >> level > 1 ? texture.width >> level : 1;
  const int height = texture.height >> level > 1 ? texture.height >> level : 1;
  const std::uint16_t* texels = texture.texels + 4 * texture.level_offset[level];
  const float x = minimum(maximum(s * static_cast<float>(width) - 0.5F, 0.0F), static_cast<float>(width - 1));
  const float y = minimum(maximum(t * static_cast<float>(height) - 0.5F, 0.0F), static_cast<float>(height - 1));
  const int column = static_cast<int>(x);
  const int row = static_cast<int>(y);
  const int right = column + 1 < width ? column + 1 : column;
  const int below = row + 1 < height ? row + 1 : row;
  const float across = x - static_cast<float>(column);
  const float down = y - static_cast<float>(row);
  const Quad top =
      (1.0F - across) * overlay_texel(texels, width, column, row) + across * overlay_texel(texels, width, right, row);
  const Quad bottom = (1.0F - across) * overlay_texel(texels, width, column, below) +
                      across * overlay_texel(texels, width, right, below);
  return (1.0F - down) * top + down * bottom;
}

//! Samples the texture at a fractional level, by interpolation between the two nearest levels.
ERGO_HD Quad overlay_sample(const OverlayTexture& texture, float level, float s, float t) {
  const float coarsest = static_cast<float>(texture.level_count - 1);
  const float at = minimum(maximum(level, 0.0F), coarsest);
  const int fine = static_cast<int>(at);
  const float part = at - static_cast<float>(fine);
  const Quad first = overlay_between(texture, fine, s, t);
  return part > 0.0F ? (1.0F - part) * first + part * overlay_between(texture, fine + 1, s, t) : first;
}
}  // namespace detail

//! Returns the light and alpha that a pixel sees of a texture: the mean over its footprint, an
//! ellipse. Takes up to eight samples along its longer axis and two along the shorter, in the level
//! whose texels have that spacing. A footprint of one texel's size, on that texel, yields exactly
//! its value.
ERGO_HD Quad filtered_overlay(const OverlayTexture& texture, const OverlayFootprint& footprint) {
  constexpr float max_samples = 8.0F;
  // A footprint wider than a texel by at most this still counts as one texel wide.
  constexpr float slack = 0.05F;
  const float width = static_cast<float>(texture.width);
  const float height = static_cast<float>(texture.height);
  const float ux = footprint.s_along_x * width;
  const float uy = footprint.s_along_y * width;
  const float vx = footprint.t_along_x * height;
  const float vy = footprint.t_along_y * height;
  // The ellipse: eigenvalues of J Jᵀ, and the eigenvector of the larger one.
  const float a = ux * ux + uy * uy;
  const float b = ux * vx + uy * vy;
  const float c = vx * vx + vy * vy;
  const float middle = 0.5F * (a + c);
  const float apart = sqrt(0.25F * (a - c) * (a - c) + b * b);
  const float longer = sqrt(middle + apart);
  const float shorter = safe_sqrt(middle - apart);
  const float axis_u = a >= c ? middle + apart - c : b;
  const float axis_v = a >= c ? b : middle + apart - a;
  const float length = sqrt(axis_u * axis_u + axis_v * axis_v);
  const float u = length > 0.0F ? axis_u / length : 1.0F;
  const float v = length > 0.0F ? axis_v / length : 0.0F;
  const float samples = ::ceilf(longer / maximum(0.5F * shorter, 1.0F) - slack);
  const int along = static_cast<int>(minimum(maximum(samples, 1.0F), max_samples));
  const int across = shorter > 1.0F + slack ? 2 : 1;
  const float step = longer / static_cast<float>(along);
  const float side_step = shorter / static_cast<float>(across);
  const float level = ::log2f(maximum(maximum(step, side_step), 1.0F));
  Quad sum = quad_of(0.0F);
  for (int k = 0; k < across; ++k) {
    const float beside = side_step * (static_cast<float>(k) - 0.5F * static_cast<float>(across - 1));
    for (int i = 0; i < along; ++i) {
      const float ahead = step * (static_cast<float>(i) - 0.5F * static_cast<float>(along - 1));
      sum = sum + detail::overlay_sample(texture, level, footprint.s + (ahead * u - beside * v) / width,
                                         footprint.t + (ahead * v + beside * u) / height);
    }
  }
  return (1.0F / (65535.0F * static_cast<float>(along * across))) * sum;
}

}  // namespace ERGO_TARGET
}  // namespace ergodome
