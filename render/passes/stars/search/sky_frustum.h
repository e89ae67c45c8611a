#pragma once

#include "kernels/stars/search/star_patch.h"

namespace ergodome {

//! Part of the sky bounded by planes through its center: directions d with dot(inward[i], d) >= 0
//! for all i.
struct SkyFrustum {
  //! Unit vectors: inward normals of the four sides, then the frustum's axis.
  Vector3<double> inward[5];
};

//! Returns the coordinate frame of a patch whose center is in the direction of the unit vector
//! `axis`; its first axis is along the patch's longer direction (u or v).
PatchFrame frame_of(const BezierPatch& patch, const Vector3<double>& axis);

//! Transforms a patch to the coordinates of a frame.
BezierPatch in_frame(const BezierPatch& patch, const PatchFrame& frame);

//! Returns the frustum that contains a patch with a margin of `error` [rad]. The patch is given in
//! its frame and lies within 90 degrees of its axis.
SkyFrustum frustum_of(const BezierPatch& patch, const PatchFrame& frame, double error = 0.0);

//! Returns bounds of z and azimuth in a frustum, slightly enlarged.
SkyBounds bounds_of(const SkyFrustum& frustum);

//! Returns an approximate upper bound of the solid angle of a frustum [sr].
double solid_angle(const SkyFrustum& frustum);

//! Returns a frustum in the form that the star field uses to search for stars.
SkyPart sky_part(const SkyFrustum& frustum);

//! Returns the rotation by the angle φ [rad] around the z axis.
SkyRotation sky_rotation(double phi);

}  // namespace ergodome
