#pragma once

#include "kernels/stars/search/sky_part.h"
#include "render/passes/stars/search/bezier_patch.h"

namespace ergodome {

//! A part of the sky between planes through its middle: directions d with dot(inward[i], d) >= 0 for all i.
struct SkyFrustum {
  Vector3<double> inward[5];  //!< unit vectors: four sides, and the way that the frustum looks
};

//! The frame of a patch whose middle lies along the unit vector `axis`.
PatchFrame frame_of(const BezierPatch& patch, const Vector3<double>& axis);

//! A patch in coordinates along the axes of a frame.
BezierPatch in_frame(const BezierPatch& patch, const PatchFrame& frame);

//! The frustum that holds a patch, and `error` [rad] more. The patch is given in its own frame, and within a quarter turn of its axis.
SkyFrustum frustum_of(const BezierPatch& patch, const PatchFrame& frame, double error = 0.0);

//! The bounds of a frustum, and a little more.
SkyBounds bounds_of(const SkyFrustum& frustum);

//! What of the sky a frustum holds, at the most, about [sr].
double solid_angle(const SkyFrustum& frustum);

//! A frustum as stars are sought in it.
SkyPart sky_part(const SkyFrustum& frustum);

//! A turn by φ about z [rad].
SkyTurn sky_turn(double phi);

}  // namespace ergodome
