#pragma once

#include "kernels/stars/search/bezier_patch.h"
#include "kernels/stars/search/sky_part.h"

// Patches of a lens grid in which images of stars are sought.
namespace ergodome {

//! Upper limit of the brightening of stars for an observer: `brighter`, times the magnification in
//! the rain frame, times the gain of the star's class in that row of ShiftGains.
struct PatchLight {
  float brighter;
  int shift_row;
};

//! A part of a lens grid over which the lens is simple enough to be inverted.
struct StarPatch {
  BezierPatch sky;  //!< in its own frame
  PatchFrame frame;
  SkyPart part;       //!< encloses all of it on the sky
  float gamma_turns;  //!< its rectangle in the chart
  float s;
  float width_turns;
  float height;
  PatchShape shape;
  int leaf;        //!< leaf of the grid that it is part of
  float brighter;  //!< factor by which an image in it may be brighter than the grid indicates
  bool exact;      //!< images in it need no rays after their correction, unless it is folded
  //! Distance by which it may miss the sky where that matters, next to critical curves [rad].
  float error;
  int halvings;  //!< maximum number of halvings in its search, if it is not regular
  PatchLight light;
  Vector3<float> seen;  //!< direction to it in the observer's frame
  float seen_radius;    //!< half angle of a cone about that direction that encloses it [rad]
  //! Maximum solid angle of the rain frame's camera per unit of its (u, v) [sr].
  float most_camera;
  //! Maximum in the rain frame; if folded, exceeded only on 1e-8 sr of the sky.
  float magnification;
};

}  // namespace ergodome
