#pragma once

#include "kernels/core/arithmetic.h"
#include "kernels/core/vector3.h"
#include "kernels/shells/shell_appearance.h"
#include "kernels/shells/shell_emitter.h"
#include "kernels/sky/elliptic_filter.h"

// Light of a shell as a pixel sees it.
namespace ergodome::inline ERGO_TARGET {

namespace detail {

//! Returns the fraction of an interval of length `stretch` about x that is covered by lines of
//! width w about the multiples of a spacing. It is exact if the interval contains few lines, and w
//! / spacing if it contains many or if `stretch` is NaN.
ERGO_HD float line_coverage(float x, float spacing, float width, float stretch) {
  constexpr float many = 16.0F;
  if (!(stretch < many * spacing)) {
    return minimum(width / spacing, 1.0F);
  }
  const float w = minimum(width, spacing);
  const float f = maximum(stretch, 1e-6F);
  // Measured from the nearest line, so that narrow lines are not lost to rounding.
  const float from_line = x - spacing * ::floorf(x / spacing + 0.5F);
  const auto covered_before = [&](float t) {
    const float lines = ::floorf(t / spacing + 0.5F);
    return lines * w + minimum(maximum(t - lines * spacing, -0.5F * w), 0.5F * w);
  };
  const float covered = covered_before(from_line + 0.5F * f) - covered_before(from_line - 0.5F * f);
  return minimum(maximum(covered / f, 0.0F), 1.0F);
}

}  // namespace detail

//! A position on a shell as one pixel sees it.
struct ShellFootprint {
  Vector3<float> direction;  //!< unit vector from the shell's center
  Vector3<float> along_x;    //!< derivative of `direction` per pixel to the right
  Vector3<float> along_y;    //!< derivative of `direction` per pixel downwards
};

//! Returns the width of a footprint [rad].
ERGO_HD float footprint_width(const ShellFootprint& at) {
  return sqrt(maximum(dot(at.along_x, at.along_x), dot(at.along_y, at.along_y)));
}

//! Returns the fraction of a pixel that a grid covers. All lines are `width` wide [rad], so
//! meridians cover ever more of a circle of latitude towards the poles, and all of it where they
//! touch. The result is a round spot of radius width / spacing, without moiré.
ERGO_HD float grid_coverage(const ShellFootprint& at, float spacing, float width) {
  const Vector3<float>& d = at.direction;
  // The sine is at least a quarter of the footprint's width, so that the lines stay finite at a
  // pole.
  const float sine = maximum(sqrt(d.x * d.x + d.y * d.y), maximum(0.25F * footprint_width(at), 1e-6F));
  const auto polar = [&](const Vector3<float>& v) { return (d.z * (d.x * v.x + d.y * v.y)) / sine - sine * v.z; };
  const auto azimuthal = [&](const Vector3<float>& v) { return (d.x * v.y - d.y * v.x) / (sine * sine); };
  const auto stretch = [&](float x, float y) { return sqrt(x * x + y * y); };
  const float theta = ::atan2f(sqrt(d.x * d.x + d.y * d.y), d.z);
  const float phi = ::atan2f(d.y, d.x);
  const float circles = detail::line_coverage(theta, spacing, width, stretch(polar(at.along_x), polar(at.along_y)));
  const float meridians =
      detail::line_coverage(phi, spacing, width / sine, stretch(azimuthal(at.along_x), azimuthal(at.along_y)));
  return circles + meridians - circles * meridians;
}

//! Light of one surface, weighted by how much of the pixel it covers.
struct CoveredLight {
  Vector3<float> light;
  float opacity;
};

//! Returns what a pixel sees of a shell: lines over the fill between them. `g` is ν_observed /
//! ν_emitted. If `shifted`, the light is multiplied by g⁴, as for the sky map; its color stays the
//! same, because the shell has no spectrum to shift.
ERGO_HD CoveredLight shell_light(const ShellAppearance& appearance, const ShellFootprint& at, float g, bool shifted) {
  const float coverage = appearance.line_width > 0.0F && appearance.line_opacity > 0.0F
                             ? grid_coverage(at, appearance.spacing, appearance.line_width)
                             : 0.0F;
  const float line = appearance.line_opacity * coverage;
  const float fill = appearance.fill_opacity * (1.0F - line);
  Vector3<float> between = appearance.fill;
  if (appearance.textured && fill > 0.0F) {
    const Quad texel = filter_sky<float>(appearance.texture, at.direction, at.along_x, at.along_y, 1.0F).pixel[0];
    between = {between.x * quad_part(texel, 0), between.y * quad_part(texel, 1), between.z * quad_part(texel, 2)};
  }
  const float g2 = shifted ? minimum(g * g, 1e6F) : 1.0F;
  return {(g2 * g2) * (line * appearance.line + fill * between), line + fill};
}

}  // namespace ergodome::inline ERGO_TARGET
