#pragma once

#include "render/stars/bezier_patch.h"

namespace ergodome {

//! A part of the sky between planes through its middle: directions d with dot(inward[i], d) >= 0 for all i.
struct SkyFrustum {
  Vector3<double> inward[5];  //!< unit vectors: four sides, and the way that the frustum looks
};

//! Axes of the sky by which a patch is narrow: unit vectors across each other.
struct PatchFrame {
  Vector3<double> first;   //!< the way the patch is long
  Vector3<double> second;  //!< the way it is narrow
  Vector3<double> axis;    //!< to its middle
};

//! The frame of a patch whose middle lies along the unit vector `axis`.
PatchFrame frame_of(const BezierPatch& patch, const Vector3<double>& axis);

//! A patch in coordinates along the axes of a frame.
BezierPatch in_frame(const BezierPatch& patch, const PatchFrame& frame);

//! The frustum that holds a patch, and `error` [rad] more. The patch is given in its own frame, and within a quarter turn of its axis.
SkyFrustum frustum_of(const BezierPatch& patch, const PatchFrame& frame, double error = 0.0);

//! What a part of the sky has of heights and azimuths.
struct SkyBounds {
  float low;          //!< least height z
  float high;         //!< greatest
  float turns;        //!< where its azimuths begin, in [0, 1)
  float width_turns;  //!< and how far they go on; 1 about a pole
};

//! The bounds of a frustum, and a little more.
SkyBounds bounds_of(const SkyFrustum& frustum);

//! What of the sky a frustum holds, at the most, about [sr].
double solid_angle(const SkyFrustum& frustum);

//! A frustum as stars are sought in it.
struct SkyPart {
  float inward[4][3];  //!< its four sides
  SkyBounds bounds;
};

SkyPart sky_part(const SkyFrustum& frustum);

//! A turn by φ about z.
struct SkyTurn {
  float turns;  //!< in [0, 1)
  float sine;
  float cosine;
};

SkyTurn sky_turn(double phi);

//! The part after the sky's mirror image across the equator, if `mirrored`, and then a turn.
SkyPart turned(const SkyPart& part, const SkyTurn& turn, bool mirrored);

}  // namespace ergodome
