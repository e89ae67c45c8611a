#pragma once

#include "kernels/shells/shell_emitter.h"
#include "kernels/shells/shell_grid.h"
#include "kernels/shells/shell_look.h"
#include "kernels/sky/elliptic_filter.h"

// Light of a shell as a pixel sees it.
namespace ergodome::inline ERGO_TARGET {

//! Light of one surface, weighted by how much of the pixel it covers.
struct CoveredLight {
  Vector3<float> light;
  float opacity;
};

//! Returns what a pixel sees of a shell: lines over the fill between them. `g` is ν_observed /
//! ν_emitted. Colors have no spectrum to shift, so only the brightness is multiplied by g⁴, as for
//! the sky map.
ERGO_HD CoveredLight shell_light(const ShellLook& look, const ShellFootprint& at, float g, bool shifted) {
  const float coverage =
      look.line_width > 0.0F && look.line_opacity > 0.0F ? grid_coverage(at, look.spacing, look.line_width) : 0.0F;
  const float line = look.line_opacity * coverage;
  const float fill = look.fill_opacity * (1.0F - line);
  Vector3<float> between = look.fill;
  if (look.textured && fill > 0.0F) {
    const Quad texel = filter_sky<float>(look.texture, at.direction, at.along_x, at.along_y, 1.0F).pixel[0];
    between = {between.x * quad_part(texel, 0), between.y * quad_part(texel, 1), between.z * quad_part(texel, 2)};
  }
  const float g2 = shifted ? minimum(g * g, 1e6F) : 1.0F;
  return {(g2 * g2) * (line * look.line + fill * between), line + fill};
}

}  // namespace ergodome::inline ERGO_TARGET
