#pragma once

#include "calibration/projectors/projector_optics.h"
#include "calibration/warps/warp_mesh.h"
#include "kernels/projection/make_projection.h"

namespace ergodome {

//! The part of the sphere that is the dome's screen. Light below its rim is not on the screen.
struct DomeScreen {
  double tilt_deg = 0.0;             //!< inclination of its top to the front
  double field_of_view_deg = 180.0;  //!< of the domemaster; 180 is a hemisphere
};

//! Computes the position in the domemaster of a point of the dome's sphere: u to the right, v down,
//! 0 to 1. Returns false beyond the rim.
bool master_place(const DomeScreen& screen, const Vector3<double>& point, double& u, double& v);

//! Computes the same for nodes of meshes, up to a quarter of the radius beyond the rim, which cells
//! across the rim need.
bool master_place_near_rim(const DomeScreen& screen, const Vector3<double>& point, double& u, double& v);

//! Returns the warp with which a projector shows a domemaster of `master_px` undistorted on the
//! dome: a mesh over the whole raster, as coarse as `tolerance_px` allows, but with at most 1,025
//! nodes per side. The tolerance is in pixels of the master or of the projector, whichever are
//! larger. Nodes just beyond the dome's rim are kept, so that cells reach the rim; those far beyond
//! are not drawn. Intensities are 1. Throws Error if the projector lights no part of the dome.
WarpMesh dome_warp(const ProjectorOptics& projector, const DomeScreen& screen, int master_px, double tolerance_px);

}  // namespace ergodome
