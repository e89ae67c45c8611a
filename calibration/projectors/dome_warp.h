#pragma once

#include "calibration/projectors/projector_optics.h"
#include "calibration/warps/warp_mesh.h"
#include "kernels/projection/make_projection.h"

namespace ergodome {

//! The part of the sphere that is the dome's screen. Light below its rim is not on the screen.
struct DomeScreen {
  double tilt_deg = 0.0;             //!< inclination of the dome's top to the front
  double field_of_view_deg = 180.0;  //!< field of view of the domemaster; 180 is a hemisphere
};

//! Computes the position in the domemaster of a point of the dome's sphere: u to the right, v down,
//! 0 to 1. Returns false beyond the rim.
bool master_position(const DomeScreen& screen, const Vector3<double>& point, double& u, double& v);

//! Computes the same as master_position(), also for points beyond the rim, up to a quarter of the
//! domemaster's radius. Cells of a mesh that cross the rim need such nodes.
bool master_position_near_rim(const DomeScreen& screen, const Vector3<double>& point, double& u, double& v);

//! Returns the warp with which a projector shows a domemaster of `master_px` undistorted on the
//! dome: a mesh over the whole raster, as coarse as `tolerance_px` allows, but with at most 1,025
//! nodes per side. The unit of the tolerance is a pixel of the master or of the projector,
//! whichever is larger. Nodes just beyond the dome's rim are valid, so that cells reach the rim.
//! Nodes far beyond it are invalid, so that their cells are not drawn. Intensities are 1. Throws
//! Error if the projector lights no part of the dome.
WarpMesh dome_warp(const ProjectorOptics& projector, const DomeScreen& screen, int master_px, double tolerance_px);

}  // namespace ergodome
