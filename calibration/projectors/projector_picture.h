#pragma once

#include <string>
#include <vector>

#include "calibration/dome/dome_blend.h"
#include "calibration/dome/dome_setup.h"
#include "calibration/projectors/grid_offsets.h"
#include "calibration/projectors/projector_files.h"

namespace ergodome {

//! Largest error of a warp that is computed from a lens [px of a domemaster 4096 wide].
inline constexpr double computed_tolerance_px = 0.25;

//! All that makes a projector's picture out of a domemaster, whatever files it came from.
struct ProjectorPicture {
  std::string name;
  int width_px = 0;
  int height_px = 0;
  WarpMesh warp;         //!< places of the domemaster (180°, front at the bottom) over the raster
  GridOffsets offsets;   //!< not yet applied to warp and masks
  BlendMap blend;        //!< linear factors of the light; width 0: none
  BlendMap black_level;  //!< linear parts of the lift; width 0: all of it everywhere
  Vector3<double> black_level_lift{};
  Vector3<double> gain{1.0, 1.0, 1.0};
  double gamma = 2.2;
  std::vector<std::string> notes;  //!< remarks on the warp's file, for the user
};

//! Whether light of all projectors can be computed.
bool all_have_lenses(const DomeSetup& setup);

//! The light of all projectors of a setup, by their lenses and places.
DomeBlend blend_of(const DomeSetup& setup);

//! The warp of a projector that shows a domemaster, turned by the setup's rotation: its own, or that of its surface or lens, or where it
//! has none computed from its place. Throws Error, naming the projector, where nothing tells it, and where a warp shows no part of the
//! master.
WarpMesh master_warp(const DomeSetup& setup, const ProjectorSetup& projector, const LoadedProjector& loaded,
                     double tolerance_px = computed_tolerance_px);

//! Converts a warp of what a flat lens at the dome's middle shows to one of the domemaster of a dome that is
//! tilted by `tilt_deg`.
WarpMesh through_lens(double tilt_deg, const WarpMesh& warp, const Orientation& orientation, const Frustum& frustum);

//! Resolution of computed masks: the raster's, or a coarse preview that takes a small part of the time.
enum class MaskDetail { full, preview };

//! The pictures of all projectors of a setup. Where all of them have a lens, those without a warp and a mask get the mask of calibration/
//! dome_blend.h. Throws Error for what load_projector and master_warp refuse, and for a setup without projectors.
//!
//! `tolerance_px`: largest error of warps that are computed from lens and position, see dome_warp().
std::vector<ProjectorPicture> projector_pictures(const DomeSetup& setup, double tolerance_px = computed_tolerance_px,
                                                 MaskDetail detail = MaskDetail::full);

//! Width of a domemaster [px] whose pixels are no larger than the projectors' are on it, but for the finest twentieth of these; a multiple of
//! 64, 256 to 8192.
int enough_master_px(const std::vector<ProjectorPicture>& pictures);

}  // namespace ergodome
