#pragma once

#include "kernels/launch/kernel.h"
#include "kernels/stars/search/star_patch.h"

// Moves patches of a lens grid with the camera.
namespace ergodome {

//! Relative margin of the part of the sky in which a patch's stars are sought: images are found
//! slightly beyond the borders of patches.
inline constexpr float part_slack = 0.01F;
//! Minimum angular margin of that part [rad].
inline constexpr float min_part_slack = 1e-6F;

//! Coefficients of a patch's motion, in the patch's frame, for offsets Δr and Δθ of the camera: those
//! of Δr, Δθ, Δr² and Δr Δθ.
struct PatchMotion {
  BezierPatch along_r;
  BezierPatch along_theta;
  BezierPatch along_r_r;
  BezierPatch along_r_theta;
};

//! Moves patches to another camera position. Arrays have `count` elements.
struct PatchMotionBatch {
  int count;
  //! Patches of the old position. SkyPart::bounds must enclose the patch at both positions.
  const StarPatch* from;
  const PatchMotion* motions;
  float along_r;      //!< change of r [M]
  float along_theta;  //!< change of θ [rad]
  double turn[3][3];  //!< rotation of the sky from the old position to the new one, by rows
  StarPatch* moved;   //!< out: the patches, with the planes that enclose them at the new position
};

template <>
struct Kernel<PatchMotionBatch> : KernelDefaults {
  static constexpr bool counted = false;
  static constexpr bool one_element_a_call = true;
  static constexpr int grain = 512;
  static const char* name(const PatchMotionBatch& /*batch*/) { return "move_patches"; }
  static int elements(const PatchMotionBatch& batch) { return batch.count; }
};

}  // namespace ergodome
