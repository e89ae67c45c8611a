#pragma once

#include <cmath>

#include "kernels/core/arithmetic.h"
#include "kernels/stars/search/patch_newton.h"
#include "kernels/stars/search/rough_image.h"
#include "kernels/stars/search/search_inputs.h"
#include "kernels/stars/seen_image.h"

// Steps of the search for images of stars in patches, for one patch, pair or root. Two drivers call
// them: that of the CPU, which collects pairs in packs (render/passes/stars/search/rough_images.h),
// and that of the GPU, with one pair per thread (patch_search_kernel.h). Steps for packs of pairs
// are in star_bands_kernel.h, patch_pairs_kernel.h, part_halving_kernel.h and
// part_solving_kernel.h.
namespace ergodome::inline ERGO_TARGET {

//! If the root of a one-to-one patch is farther outside than this [fractions of the patch], the
//! patch holds no image.
inline constexpr float near_outside = 0.1F;

//! Returns whether the view may overlap a patch, or its mirror image if `mirrored`.
ERGO_HD bool may_be_seen(const ViewCone& view, const StarPatch& patch, bool mirrored) {
  const Vector3<double> direction = {static_cast<double>(patch.seen.x),
                                     static_cast<double>(mirrored ? -patch.seen.y : patch.seen.y),
                                     static_cast<double>(patch.seen.z)};
  return may_touch(view, direction, static_cast<double>(patch.seen_radius));
}

//! Returns the pair of a patch and a star, which may be in its mirror image.
ERGO_HD SearchedPair pair_of(const SearchInputs& inputs, int patch, bool mirrored, int star) {
  const PatchFrame& frame = inputs.patches[patch].frame;
  const Vector3<double> d = as_patches_see(inputs.turn, inputs.field.stars[star].direction, mirrored);
  const double depth = dot(d, frame.axis);
  return {patch,
          star,
          static_cast<float>(depth),
          static_cast<float>(dot(d, frame.first) / depth),
          static_cast<float>(dot(d, frame.second) / depth),
          mirrored};
}

//! Returns the limits of Newton's method in patches that are not folded.
ERGO_HD NewtonLimits newton_limits(PatchShape shape) {
  return shape == PatchShape::regular ? NewtonLimits{farthest_regular, rounds_regular}
                                      : NewtonLimits{any_step, rounds_bent};
}

//! Result of Newton's method for a pair.
enum class PairResult {
  no_image,
  image,     //!< the pair has an image at the root
  undecided  //!< the pair must be searched like one of a folded patch
};

//! Decides from the end of Newton's method at (u, v) whether a pair has an image. `side`: on which
//! side of a bent patch's border the star is; callers drop pairs whose star is outside.
ERGO_HD PairResult pair_result(PatchShape shape, PatchSide side, bool found, float u, float v) {
  const PatchPosition<float> end = {u, v};
  if (found && within_patch(end, beyond_patch)) {
    return PairResult::image;
  }
  const bool decided =
      shape == PatchShape::regular || (side != PatchSide::inside && found && within_patch(end, near_outside));
  return decided ? PairResult::no_image : PairResult::undecided;
}

//! Returns the maximum number of roots of a patch that is searched by halving.
ERGO_HD int roots_wanted(const StarPatch& patch) { return patch.shape == PatchShape::bent ? 1 : max_roots; }

//! Returns whether a root may be added to the `count` roots found so far: it lies within the patch
//! and differs from all of them, and fewer than `wanted` roots have been found (if the root is a
//! guess, also fewer than max_guesses).
ERGO_HD bool may_add_root(const FoldedRoot* roots, int count, int wanted, const FoldedRoot& root) {
  const bool guess = root.area == 0.0F;
  bool may = count < wanted && !(guess && count >= max_guesses) && within_patch<float>({root.u, root.v}, beyond_patch);
  for (int i = 0; may && i < count; ++i) {
    may = !(maximum(::fabsf(roots[i].u - root.u), ::fabsf(roots[i].v - root.v)) < same_root);
  }
  return may;
}

//! Computes the image at a root of a pair's patch. Returns false if it is too faint.
ERGO_HD bool image_at_root(const SearchInputs& inputs, const SearchedPair& pair, const FoldedRoot& root,
                           RoughImage& image) {
  const StarPatch& patch = inputs.patches[pair.patch];
  const FieldStar& star = inputs.field.stars[pair.star];
  // Solid angle of the sky per unit square of the patch. Areas in the plane z = 1 of the patch's
  // frame exceed the solid angles behind them by a factor of 1 / depth.
  const float sky = maximum(::fabsf(root.area), 1e-30F) * pair.depth;
  // Upper limit of the image's illuminance over the star's, including its frequency shift.
  const float gain = patch.brighter * (patch.max_camera / sky) * patch.light.brighter *
                     inputs.field.gains[patch.light.shift_row].gain[star_class(star.log_temperature)];
  if (!(star.illuminance * gain >= inputs.faintest)) {
    return false;
  }
  // The sign changes because position angles run round the chart's center in the opposite sense to
  // areas in the plane.
  ChartImage at = {patch.gamma_turns + root.u * patch.width_turns, patch.s + root.v * patch.height,
                   ::copysignf(sky, -root.area) / (patch.width_turns * patch.height)};
  bool exact = false;
  if (patch.exact && patch.shape != PatchShape::folded) {
    const Vector3<double> d = as_patches_see(inputs.turn, star.direction, pair.mirrored);
    exact = correct_image(inputs.corrected, patch.leaf,
                          {static_cast<float>(d.x), static_cast<float>(d.y), static_cast<float>(d.z)}, at);
  }
  const float seen = pair.mirrored ? 1.0F - at.gamma_turns : at.gamma_turns;
  image = {pair.star, seen - ::floorf(seen), at.s, at.sky, patch.brighter, exact, root.area == 0.0F};
  return true;
}

//! Completes an image that needs no rays. Returns false if it is out of view or too faint.
//! `solid_angle`: as in shining_image().
ERGO_HD bool complete_image(const ViewCone& view, const BlackbodyTable& colours, const StarAppearance& look, int number,
                            const FieldStar& star, const Vector3<float>& direction, float frequency_ratio,
                            float solid_angle, SeenImage& found) {
  const Vector3<double> axis = {static_cast<double>(direction.x), static_cast<double>(direction.y),
                                static_cast<double>(direction.z)};
  return may_touch(view, axis, 0.0) &&
         exact_image(colours, look, number, star, direction, frequency_ratio, solid_angle, found);
}

}  // namespace ergodome::inline ERGO_TARGET
