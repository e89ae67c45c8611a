#pragma once

#include "calibration/projectors/projector_optics.h"
#include "calibration/warps/warp_mesh.h"
#include "kernels/projection/make_projection.h"

namespace ergodome {

//! The part of the sphere that is the dome: what is lit below its rim is no screen.
struct DomeScreen {
  double tilt_deg = 0.0;             //!< how far its top leans to the front
  double field_of_view_deg = 180.0;  //!< of the domemaster; 180 is a hemisphere
};

//! The place in the domemaster of a point of the dome's sphere: u to the right, v down, 0 to 1. False beyond the circle's rim.
bool master_place(const DomeScreen& screen, const Vector3<double>& point, double& u, double& v);

//! The same for nodes of meshes, up to a quarter of the radius beyond the rim: cells across it need them.
bool master_place_near_rim(const DomeScreen& screen, const Vector3<double>& point, double& u, double& v);

//! The warp by which a projector shows a domemaster of `master_px` in place: a mesh that reaches from rim to rim of the raster, as coarse as
//! `tolerance_px` allows, though no finer than 1,025 nodes a side: pixels of the master, or of the projector where those are
//! larger. Nodes just beyond the dome's rim are there, so that the rim is; those far beyond are not drawn. Intensities are 1. Throws
//! Error where the projector lights no part of the dome.
WarpMesh dome_warp(const ProjectorOptics& projector, const DomeScreen& screen, int master_px, double tolerance_px);

}  // namespace ergodome
