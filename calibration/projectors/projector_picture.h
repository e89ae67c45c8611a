#pragma once

#include <string>
#include <vector>

#include "calibration/dome/dome_setup.h"
#include "calibration/projectors/dome_blend.h"
#include "calibration/projectors/grid_offsets.h"
#include "calibration/projectors/projector_files.h"

namespace ergodome {

//! Maximum error of a warp that is computed from a lens [px of a domemaster 4096 wide].
inline constexpr double computed_tolerance_px = 0.25;

//! Everything that converts a domemaster to a projector's image, whatever files it came from.
struct ProjectorPicture {
  std::string name;
  int width_px = 0;
  int height_px = 0;
  WarpMesh warp;         //!< positions in the domemaster (180°, front at the bottom) over the raster
  GridOffsets offsets;   //!< offsets that are not yet applied to warp and masks
  BlendMap blend;        //!< linear factors of the light; width 0: none
  BlendMap black_level;  //!< linear factors of the lift; width 0: full lift everywhere
  Vector3<double> black_level_lift{};
  Vector3<double> gain{1.0, 1.0, 1.0};
  double gamma = 2.2;
  std::vector<std::string> notes;  //!< remarks on the warp's file, for the user
};

//! Returns true if all projectors have a lens, so that their light can be computed.
bool all_have_lenses(const DomeSetup& setup);

//! Returns the blend of all projectors of a setup, from their lenses and poses.
DomeBlend blend_of(const DomeSetup& setup);

//! Returns the warp with which a projector shows a domemaster, rotated by the setup's rotation. It
//! comes from a warp file, from a surface or lens image, or else from the projector's pose. Throws
//! Error, which names the projector, if nothing defines the warp, or if it shows no part of the
//! master.
WarpMesh master_warp(const DomeSetup& setup, const ProjectorSetup& projector, const LoadedProjector& loaded,
                     double tolerance_px = computed_tolerance_px);

//! Converts a warp of the image of a flat lens at the dome's center to a warp of the domemaster of
//! a dome that is tilted by `tilt_deg`.
WarpMesh through_lens(double tilt_deg, const WarpMesh& warp, const Orientation& orientation, const Frustum& frustum);

//! Resolution of computed masks: the raster's, or a coarse preview that takes a fraction of the
//! time.
enum class MaskDetail { full, preview };

//! Returns the warps and masks of all projectors of a setup. If all of them have a lens, those with
//! neither a warp nor a mask get the mask of DomeBlend. Throws Error as load_projector() and
//! master_warp() do, and for a setup without projectors.
//!
//! `tolerance_px` is the maximum error of computed warps, see dome_warp().
std::vector<ProjectorPicture> projector_pictures(const DomeSetup& setup, double tolerance_px = computed_tolerance_px,
                                                 MaskDetail detail = MaskDetail::full);

//! Returns the width of a domemaster [px] whose pixels are at most as large as those of the
//! projectors on it, except for the finest twentieth of the projectors' pixels. The width is a
//! multiple of 64, from 256 to 8192.
int enough_master_px(const std::vector<ProjectorPicture>& pictures);

}  // namespace ergodome
