#pragma once

#include <cmath>

#include "kernels/core/arithmetic.h"
#include "kernels/stars/search/mended_leaf.h"
#include "kernels/stars/search/patch_newton.h"
#include "kernels/stars/search/rough_image.h"
#include "kernels/stars/search/sky_part.h"
#include "kernels/stars/search/star_patch.h"
#include "kernels/stars/star_bands.h"

// What the searches for images of stars in patches share: registers of pairs on the processor (render/stars/rough_images.h), a pair a thread
// on a device (kernels/stars/patch_search_kernel.h).
namespace ergodome::inline ERGO_TARGET {

//! Rounds of Newton's method in regular patches, and where another way is left.
inline constexpr int rounds_regular = 16;
inline constexpr int rounds_bent = 8;
//! No first step is too long.
inline constexpr float any_step = 1e6F;
//! A root so far outside of a patch that is one to one, in parts of it, says that none is inside.
inline constexpr float near_outside = 0.1F;

//! Number of equal parts of [0, 1) that a place lies in.
template <class S>
ERGO_HD int place_among(S place, int parts) {
  const int at = static_cast<int>(place * static_cast<S>(parts));
  return at < 0 ? 0 : at < parts ? at : parts - 1;
}

//! Cells of bands: those of a part of the sky lie in bands [first_band, last_band), in each from first_cell on round the sky.
struct CellRange {
  int first_band;
  int last_band;
  int first_cell;
  int cell_count;
};

ERGO_HD CellRange cells_of(const SkyBounds& bounds, const StarBands& stars) {
  const int first_cell = place_among(bounds.turns, stars.cells);
  const int last_cell = static_cast<int>((bounds.turns + bounds.width_turns) * static_cast<float>(stars.cells));
  const int count = last_cell + 1 - first_cell;
  return {place_among(0.5F * (bounds.low + 1.0F), stars.bands),
          place_among(0.5F * (bounds.high + 1.0F), stars.bands) + 1, first_cell,
          count < stars.cells ? count : stars.cells};
}

//! Whether a cone about `axis` (unit vector) of half angle `radius` [rad] may share directions with a cone about `view_axis`.
ERGO_HD bool cone_may_touch(const Vector3<double>& view_axis, double half_angle, double cosine,
                            const Vector3<double>& axis, double radius) {
  const double along = dot(view_axis, axis);
  if (along >= cosine) {
    return true;
  }
  // A cosine falls by no more than the angle grows: most answers need none.
  const double reach = half_angle + radius;
  return reach >= 3.14159265358979323846 || (along >= cosine - radius && along >= ::cos(reach));
}

//! Solid angle of the sky that a root has per unit square of its patch: the plane's areas are larger than the solid angles behind them by
//! 1 / depth.
ERGO_HD float sky_of_root(float area, float depth) { return maximum(::fabsf(area), 1e-30F) * depth; }

//! What an image in a patch gains at the most, but for the shift of its light.
ERGO_HD float most_gain(const StarPatch& patch, float sky) {
  return patch.brighter * (patch.most_camera / sky) * patch.light.brighter;
}

//! Where in the chart a root lies. Position angles go round the chart's centre the other way than planes count areas.
ERGO_HD ChartImage chart_image(const StarPatch& patch, const FoldedRoot& root, float sky) {
  return {patch.gamma_turns + root.u * patch.width_turns, patch.s + root.v * patch.height,
          ::copysignf(sky, -root.area) / (patch.width_turns * patch.height)};
}

//! Whether a root is to be added to `count` that are there, where `wanted` are wanted.
ERGO_HD bool may_add_root(const FoldedRoot* roots, int count, int wanted, const FoldedRoot& root) {
  const bool guess = root.area == 0.0F;
  bool may = count < wanted && !(guess && count >= most_guesses) && within_patch<float>({root.u, root.v}, beyond_patch);
  for (int i = 0; may && i < count; ++i) {
    may = !(maximum(::fabsf(roots[i].u - root.u), ::fabsf(roots[i].v - root.v)) < same_root);
  }
  return may;
}

}  // namespace ergodome::inline ERGO_TARGET
