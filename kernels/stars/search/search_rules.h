#pragma once

#include <cmath>

#include "kernels/core/arithmetic.h"
#include "kernels/stars/search/mended_leaf.h"
#include "kernels/stars/search/patch_newton.h"
#include "kernels/stars/search/rough_image.h"
#include "kernels/stars/search/sky_part.h"
#include "kernels/stars/search/star_patch.h"
#include "kernels/stars/star_bands.h"

// Rules that both searches for images of stars in patches share: that of the CPU, on packs of pairs
// (render/passes/stars/search/rough_images.h), and that of the GPU, with one pair per thread
// (kernels/stars/search/patch_search_kernel.h).
namespace ergodome::inline ERGO_TARGET {

//! Maximum number of Newton steps in regular patches, and in bent ones, which have a fallback.
inline constexpr int rounds_regular = 16;
inline constexpr int rounds_bent = 8;
//! A limit that no first step reaches.
inline constexpr float any_step = 1e6F;
//! If the root of a one-to-one patch is farther outside than this [fractions of the patch], the
//! patch holds no image.
inline constexpr float near_outside = 0.1F;

//! Returns which of `parts` equal parts of [0, 1) contains a position.
template <class S>
ERGO_HD int place_among(S place, int parts) {
  const int at = static_cast<int>(place * static_cast<S>(parts));
  return at < 0 ? 0 : at < parts ? at : parts - 1;
}

//! The cells of bands that a part of the sky touches: bands [first_band, last_band), and in each
//! band cell_count cells from first_cell on, round the sky.
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

//! Returns whether a cone about the unit vector `axis` with half angle `radius` [rad] may overlap
//! the cone about `view_axis`.
ERGO_HD bool cone_may_touch(const Vector3<double>& view_axis, double half_angle, double cosine,
                            const Vector3<double>& axis, double radius) {
  const double along = dot(view_axis, axis);
  if (along >= cosine) {
    return true;
  }
  // A cosine falls by at most as much as the angle grows, so most calls compute none.
  const double reach = half_angle + radius;
  return reach >= 3.14159265358979323846 || (along >= cosine - radius && along >= ::cos(reach));
}

//! Returns the solid angle of the sky per unit square of a root's patch. Areas in the plane exceed
//! the solid angles behind them by a factor of 1 / depth.
ERGO_HD float sky_of_root(float area, float depth) { return maximum(::fabsf(area), 1e-30F) * depth; }

//! Returns the maximum gain in brightness of an image in a patch, without the gain by its frequency
//! shift.
ERGO_HD float most_gain(const StarPatch& patch, float sky) {
  return patch.brighter * (patch.most_camera / sky) * patch.light.brighter;
}

//! Returns the image of a root in the chart. The sign changes because position angles run round the
//! chart's center in the opposite sense to areas in the plane.
ERGO_HD ChartImage chart_image(const StarPatch& patch, const FoldedRoot& root, float sky) {
  return {patch.gamma_turns + root.u * patch.width_turns, patch.s + root.v * patch.height,
          ::copysignf(sky, -root.area) / (patch.width_turns * patch.height)};
}

//! Returns whether a root may be added to the `count` roots found so far. `wanted`: maximum number
//! of roots.
ERGO_HD bool may_add_root(const FoldedRoot* roots, int count, int wanted, const FoldedRoot& root) {
  const bool guess = root.area == 0.0F;
  bool may = count < wanted && !(guess && count >= most_guesses) && within_patch<float>({root.u, root.v}, beyond_patch);
  for (int i = 0; may && i < count; ++i) {
    may = !(maximum(::fabsf(roots[i].u - root.u), ::fabsf(roots[i].v - root.v)) < same_root);
  }
  return may;
}

}  // namespace ergodome::inline ERGO_TARGET
